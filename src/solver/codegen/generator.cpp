// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/solver/codegen/generator.hpp"

#include <initializer_list>

#include "swarm_planner/solver/codegen/sparse_structure.hpp"
#include "write_common.hpp"

namespace swarm_planner {
namespace codegen {

namespace {

std::string templates(std::initializer_list<const char*> names) {
  std::string text;
  for (const char* name : names) text += "\n" + templateText(name);
  return text;
}

/// The solver around the parts that a description of one copy and one of several have in common.
std::string writeSolver(const Description& d, const Structure& s) {
  if (d.copies > 1) {
    return templates({"copies_rows.c", "copies_scan.c", "working_set.c", "active_set_loop.c", "copies_solve.c"});
  }
  return templates({"one_copy.c", "working_set.c", "active_set_loop.c", "root.c"}) +
         "\n/* ---- Interior point: Riccati recursion in straight-line stages. ---- */\n\n" + writeRiccati(d, s) +
         templates({"interior_point.c", "interior_point_loop.c", "solve.c"});
}

}  // namespace

GeneratedCode generate(const Description& d) {
  const Structure s = analyse(d);
  const Layout layout = makeLayout(d, s);
  const std::string header =
      writeSizes(d, s, layout) + "\n" + templateText("status.h") + "\n" + templateText("tables.h") + "\n" +
      templateText(d.copies > 1 ? "copies_types.h" : "types.h") + "\n" + writeInterface(d, s, layout);
  std::string source;
  source += templateText("common.c") + "\n" + writeConstants(d, s, layout) + "\n" + writeEvaluate(d, s) + "\n";
  source += writeStage(d, s);
  source += templates({"sweep.c", "setup.c", "rows.c", "scale.c", "copy_data.c", "row_access.c"}) + writeSolver(d, s);
  return finishCode(d.name, header, source);
}

GeneratedCode generate(const SparseDescription& d) {
  const SparseStructure s = analyse(d);
  const std::string header = writeSizes(d, s) + "\n" + templateText("status.h") + "\n" +
                             templateText("sparse_types.h") + "\n" + writeInterface(d);
  std::string source = templateText("common.c") + templates({"root.c"}) + "\n" + writeTables(d, s) + "\n";
  source += templateText("sparse_matrix.c") + "\n" + templateText("sparse_pivot.c") + "\n";
  source += (s.straightLine() ? writeStraightLineFactor(s) : templateText("sparse_factor.c")) + "\n";
  source += templateText("sparse_newton.c") + "\n" + templateText("sparse_interior_point.c") + "\n";
  source += writeEvaluate(d) + "\n" + templateText("sparse_solve.c");
  return finishCode(d.name, header, source);
}

GeneratedCode generateFromText(const std::string& yaml_text) {
  if (isSparseDescription(yaml_text)) return generate(parseSparseDescription(yaml_text));
  return generate(parseDescription(yaml_text));
}

}  // namespace codegen
}  // namespace swarm_planner
