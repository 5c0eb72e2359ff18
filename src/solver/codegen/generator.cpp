// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/solver/codegen/generator.hpp"

#include "swarm_planner/solver/codegen/sparse_structure.hpp"
#include "write_common.hpp"

namespace swarm_planner {
namespace codegen {

GeneratedCode generate(const Description& d) {
  const Structure s = analyse(d);
  const Layout layout = makeLayout(d, s);
  const std::string header = writeSizes(d, s, layout) + "\n" + templateText("status.h") + "\n" +
                             templateText("types.h") + "\n" + writeInterface(d, s, layout);
  std::string source;
  source += templateText("common.c") + "\n" + writeConstants(d, s, layout) + "\n" + writeEvaluate(d, s) + "\n";
  source += writeStage(d, s);
  for (const char* part : {"sweep.c", "setup.c", "rows.c", "scale.c", "active_set.c", "active_set_loop.c"}) {
    source += "\n" + templateText(part);
  }
  source += "\n/* ---- Interior point: Riccati recursion in straight-line stages. ---- */\n\n" + writeRiccati(d, s);
  source += "\n" + templateText("interior_point.c") + "\n" + templateText("interior_point_loop.c");
  source += "\n" + templateText("solve.c");
  return finishCode(d.name, header, source);
}

GeneratedCode generate(const SparseDescription& d) {
  const SparseStructure s = analyse(d);
  const std::string header = writeSizes(d, s) + "\n" + templateText("status.h") + "\n" +
                             templateText("sparse_types.h") + "\n" + writeInterface(d);
  std::string source = templateText("common.c") + "\n" + writeTables(d, s) + "\n";
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
