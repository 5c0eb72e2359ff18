# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
# Writes OUTPUT: templateText(), the text of each of TEMPLATES by file name.
set(code "#include <map>\n#include \"swarm_planner/solver/codegen/generator.hpp\"\n\n")
string(APPEND code "const std::string& swarm_planner::codegen::templateText(const std::string& name) {\n")
string(APPEND code "  static const std::map<std::string, std::string> texts{\n")
foreach(template IN LISTS TEMPLATES)
  get_filename_component(name ${template} NAME)
  file(READ ${template} text)
  string(APPEND code "      {\"${name}\", R\"qpc(${text})qpc\"},\n")
endforeach()
string(APPEND code "  };\n  return texts.at(name);\n}\n")
file(WRITE ${OUTPUT} "${code}")
