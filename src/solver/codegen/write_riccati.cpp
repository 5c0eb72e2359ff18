// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <sstream>

#include "swarm_planner/solver/codegen/generator.hpp"
#include "swarm_planner/solver/codegen/straight_line.hpp"

namespace swarm_planner {
namespace codegen {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// The stage matrices in the caller's order of states and inputs, z = [x; previous u if there is a rate cost], as
/// atoms of C code.
struct StageMatrices {
  int z = 0, u = 0;
  AtomMatrix a, b;         ///< z+ = a z + b u
  AtomMatrix q, terminal;  ///< z' q z
  AtomMatrix r;            ///< u' r u, rate included
  AtomMatrix cross;        ///< u' cross z
};

class StageBuilder {
 public:
  StageBuilder(const Description& d, const Structure& s) : d_(d), s_(s) {}

  StageMatrices build() const {
    const bool rate = !d_.rate_cost.empty();
    StageMatrices m;
    m.u = d_.inputs;
    m.z = d_.states + (rate ? d_.inputs : 0);
    m.a = AtomMatrix(m.z, m.z);
    m.b = AtomMatrix(m.z, m.u);
    m.q = AtomMatrix(m.z, m.z);
    m.terminal = AtomMatrix(m.z, m.z);
    m.r = AtomMatrix(m.u, m.u);
    m.cross = AtomMatrix(m.u, m.z);
    for (int i = 0; i < d_.states; ++i) {
      for (int j = 0; j < d_.states; ++j) {
        m.a(i, j) = atom(d_.a(i, j), "a", state(i), state(j));
        m.q(i, j) = atom(d_.stage_cost(i, j), "stage_cost", state(i), state(j));
        m.terminal(i, j) = atom(d_.terminal_cost(i, j), "terminal_cost", state(i), state(j));
      }
      for (int j = 0; j < d_.inputs; ++j) m.b(i, j) = atom(d_.b(i, j), "b", state(i), input(j));
    }
    for (int i = 0; i < d_.inputs; ++i) {
      for (int j = 0; j < d_.inputs; ++j) addInputCost(m, i, j);
      if (rate) m.b(d_.states + i, i) = Atom::one();
    }
    return m;
  }

  /// C or D of an output.
  AtomMatrix output(int o, bool of_state) const {
    const Output& output = d_.outputs[at(o)];
    const ExpressionMatrix& source = of_state ? output.state : output.input;
    AtomMatrix m(output.size(), of_state ? d_.states + (d_.rate_cost.empty() ? 0 : d_.inputs) : d_.inputs);
    for (int i = 0; i < source.rows; ++i) {
      const Place channel{s_.output_block[at(o)][at(i)], s_.output_channel[at(o)][at(i)]};
      for (int j = 0; j < source.columns; ++j) {
        m(i, j) = atom(source(i, j), of_state ? "c" : "d", channel, of_state ? state(j) : input(j));
      }
    }
    return m;
  }

 private:
  struct Place {
    int block, index;
  };
  Place state(int i) const { return {s_.state_block[at(i)], s_.state_index[at(i)]}; }
  Place input(int i) const { return {s_.input_block[at(i)], s_.input_index[at(i)]}; }

  static Atom atom(const Expression& e, const std::string& name, Place row, Place column) {
    if (e.isZero()) return Atom::zero();
    if (e.isOne()) return Atom::one();
    if (e.isConstant()) return Atom(e.value() < 0.0 ? "(" + e.code() + ")" : e.code());
    return Atom("t->" + name + "[" + std::to_string(row.index) + "][" + std::to_string(column.index) + "][" +
                std::to_string(row.block) + "]");
  }

  void addInputCost(StageMatrices& m, int i, int j) const {
    const Atom own = atom(d_.input_cost(i, j), "input_cost", input(i), input(j));
    if (d_.rate_cost.empty()) {
      m.r(i, j) = own;
      return;
    }
    const Atom rate = atom(d_.rate_cost(i, j), "rate_cost", input(i), input(j));
    m.r(i, j) = rate.isZero() ? own : own.isZero() ? rate : Atom("(" + own.code() + " + " + rate.code() + ")");
    m.q(d_.states + i, d_.states + j) = rate;
    if (!rate.isZero()) m.cross(i, d_.states + j) = Atom("(-" + rate.code() + ")");
  }

  const Description& d_;
  const Structure& s_;
};

/// Writes the recursion of the interior-point method for one description.
class RiccatiWriter {
 public:
  RiccatiWriter(const Description& d, const Structure& s) : d_(d), builder_(d, s), m_(builder_.build()) {
    for (int o = 0; o < static_cast<int>(d.outputs.size()); ++o) {
      c_.push_back(builder_.output(o, true));
      d_matrix_.push_back(builder_.output(o, false));
    }
  }

  std::string write() {
    findPattern();
    out_ << "#define QPC_IP_STATES " << m_.z << "\n#define QPC_IP_COST_TO_GO " << m_.z * (m_.z + 1) / 2 << "\n\n";
    writeFactor();
    writeBackward();
    writeForward();
    return out_.str();
  }

 private:
  bool usesRows(int o) const { return d_.outputs[at(o)].max_rows > 0; }
  bool restricted(int o) const { return usesRows(o) || d_.outputs[at(o)].bounded || d_.max_quadratic > 0; }

  static int packed(int i, int j) { return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i; }

  /// The cost-to-go's entries as atoms p[.] where the pattern has them.
  AtomMatrix costToGo() const {
    AtomMatrix p(m_.z, m_.z);
    for (int i = 0; i < m_.z; ++i) {
      for (int j = 0; j < m_.z; ++j) {
        if (pattern_[at(packed(i, j))]) p(i, j) = Atom("p" + std::to_string(packed(i, j)));
      }
    }
    return p;
  }

  /// Weights of an output's rows, quadratic terms and bounds at the stage; bounds alone have a diagonal.
  AtomMatrix weights(int o) const {
    const int size = d_.outputs[at(o)].size();
    AtomMatrix w(size, size);
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) {
        if (i != j && !usesRows(o) && d_.max_quadratic == 0) continue;
        w(i, j) = Atom("s->ip_weight[" + std::to_string(o) + "][" + std::to_string(packed(i, j)) + "][k]");
      }
    }
    return w;
  }

  /// One step of the recursion into `code`; returns the new cost-to-go.
  AtomMatrix step(StraightLine& code) {
    AtomMatrix p = costToGo();
    for (int o = 0; o < static_cast<int>(c_.size()); ++o) {
      if (restricted(o) && !d_.outputs[at(o)].touchesInput()) {
        p = code.congruenceOf(c_[at(o)], code.product(weights(o), c_[at(o)]), p);
      }
    }
    const AtomMatrix pa = code.product(p, m_.a);
    const AtomMatrix pb = code.product(p, m_.b);
    auto f = code.congruenceOf(m_.b, pb, m_.r);
    auto g = code.transposedProduct(m_.b, pa, m_.cross);
    auto next = code.congruenceOf(m_.a, pa, m_.q);
    for (int o = 0; o < static_cast<int>(c_.size()); ++o) {
      if (!restricted(o) || !d_.outputs[at(o)].touchesInput()) continue;
      const AtomMatrix w = weights(o);
      f = code.congruenceOf(d_matrix_[at(o)], code.product(w, d_matrix_[at(o)]), f);
      g = code.transposedProduct(d_matrix_[at(o)], code.product(w, c_[at(o)]), g);
      next = code.congruenceOf(c_[at(o)], code.product(w, c_[at(o)]), next);
    }
    return eliminate(code, f, g, next);
  }

  /// L D L' of f, gain = f^-1 g, next - g' gain.
  AtomMatrix eliminate(StraightLine& code, const AtomMatrix& f, const AtomMatrix& g, const AtomMatrix& next) {
    const Factor factor = code.factor(f);
    AtomMatrix half = g;  // L^-1 g, then D^-1 of it
    for (int j = 0; j < m_.z; ++j) code.forwardSubstitute(factor, half, j);
    AtomMatrix scaled(m_.u, m_.z);
    for (int i = 0; i < m_.u; ++i) {
      for (int j = 0; j < m_.z; ++j) scaled(i, j) = code.multiply(half(i, j), factor.inverse[at(i)]);
    }
    const AtomMatrix result = code.congruenceOf(half, scaled, next, true);
    AtomMatrix gain = scaled;
    for (int j = 0; j < m_.z; ++j) code.backwardSubstitute(factor, gain, j);
    for (int i = 0; i < m_.u; ++i) {
      for (int j = 0; j < m_.z; ++j) code.store("s->ip_gain[k][" + std::to_string(i * m_.z + j) + "]", gain(i, j));
      code.store("s->ip_pivot[k][" + std::to_string(i) + "]", factor.inverse[at(i)]);
      for (int j = 0; j < i; ++j)
        code.store("s->ip_lower[k][" + std::to_string(packed(i, j)) + "]", factor.lower(i, j));
    }
    return result;
  }

  /// Which entries of the cost-to-go can be nonzero: the recursion's patterns until nothing is added.
  void findPattern() {
    pattern_.assign(at(m_.z * (m_.z + 1) / 2), false);
    add(m_.terminal);
    for (int round = 0; round < m_.z * m_.z; ++round) {
      StraightLine code;
      if (!add(step(code))) return;
    }
  }

  bool add(const AtomMatrix& p) {
    bool grown = false;
    for (int i = 0; i < m_.z; ++i) {
      for (int j = 0; j <= i; ++j) {
        if (p(i, j).isZero() || pattern_[at(packed(i, j))]) continue;
        pattern_[at(packed(i, j))] = true;
        grown = true;
      }
    }
    return grown;
  }

  void writeFactor() {
    out_ << "/* Riccati recursion with the weights of rows and bounds; stage by stage, gains and factors of the "
            "inputs'\n"
            "   Hessian. 0 if a pivot is not positive. */\n"
            "static int qpc_ip_factor(const qpc_tables* t, qpc_solver* s) {\n  (void)t;\n";
    for (int i = 0; i < m_.z; ++i) {
      for (int j = 0; j <= i; ++j) {
        if (!pattern_[at(packed(i, j))]) continue;
        out_ << "  double next_p" << packed(i, j) << " = " << m_.terminal(i, j).code() << ";\n";
      }
    }
    out_ << "  for (int k = QPC_HORIZON - 1; k >= 0; --k) {\n";
    for (std::size_t i = 0; i < pattern_.size(); ++i) {
      if (pattern_[i]) out_ << "    const double p" << i << " = next_p" << i << ";\n";
    }
    StraightLine code;
    const AtomMatrix next = step(code);
    for (int i = 0; i < m_.z; ++i) {
      for (int j = 0; j <= i; ++j) {
        if (pattern_[at(packed(i, j))]) code.store("next_p" + std::to_string(packed(i, j)), next(i, j));
      }
    }
    out_ << code.text();
    out_ << "  }\n  return 1;\n}\n\n";
  }

  AtomMatrix column(const std::string& name, int size) const {
    AtomMatrix v(size, 1);
    for (int i = 0; i < size; ++i) v(i, 0) = Atom(name + std::to_string(i));
    return v;
  }

  AtomMatrix force(int o) const {
    AtomMatrix f(d_.outputs[at(o)].size(), 1);
    for (int c = 0; c < f.rows; ++c) {
      f(c, 0) = Atom("s->ip_force[qpc_output_place[" + std::to_string(o) + "][" + std::to_string(c) + "] + k]");
    }
    return f;
  }

  /// z at stage k of the present iterate.
  AtomMatrix iterateState() const {
    AtomMatrix z(m_.z, 1);
    for (int i = 0; i < m_.z; ++i) {
      z(i, 0) = i < d_.states ? Atom("s->x[k][" + std::to_string(i) + "]")
                              : Atom("before[" + std::to_string(i - d_.states) + "]");
    }
    return z;
  }

  AtomMatrix iterateInput() const {
    AtomMatrix u(m_.u, 1);
    for (int i = 0; i < m_.u; ++i) u(i, 0) = Atom("s->u[k][" + std::to_string(i) + "]");
    return u;
  }

  void writeBackward() {
    out_ << "/* Costates of the cost's gradient at the iterate and the forces of rows and bounds, and the constant "
            "parts of\n"
            "   the inputs' steps. */\n"
            "static void qpc_ip_backward(const qpc_tables* t, qpc_solver* s) {\n  (void)t;\n";
    for (int i = 0; i < m_.z; ++i) {
      out_ << "  double next_c" << i << " = 0.0";
      for (int j = 0; j < d_.states; ++j) {
        if (m_.terminal(i, j).isZero()) continue;
        out_ << " + " << m_.terminal(i, j).code() << " * s->x[QPC_HORIZON][" << j << "]";
      }
      out_ << ";\n";
    }
    out_ << "  for (int k = QPC_HORIZON - 1; k >= 0; --k) {\n"
            "    const double* before = k > 0 ? s->u[k > 0 ? k - 1 : 0] : s->u_previous;\n    (void)before;\n";
    for (int i = 0; i < m_.z; ++i) {
      out_ << "    const double c" << i << " = next_c" << i;
      if (i < d_.states) out_ << " + s->state_linear[k][" << i << "]";
      out_ << ";\n";
    }
    StraightLine code;
    writeBackwardStage(code);
    out_ << code.text() << "  }\n}\n\n";
  }

  void writeBackwardStage(StraightLine& code) {
    AtomMatrix costate = column("c", m_.z);
    AtomMatrix slope(m_.u, 1);
    for (int i = 0; i < m_.u && d_.input_linear; ++i) {
      slope(i, 0) = Atom("s->input_linear[k][" + std::to_string(i) + "]");
    }
    for (int o = 0; o < static_cast<int>(c_.size()); ++o) {
      if (restricted(o) && !d_.outputs[at(o)].touchesInput()) {
        costate = code.transposedProduct(c_[at(o)], force(o), costate, true);
      }
    }
    slope = code.product(m_.r, iterateInput(), code.product(m_.cross, iterateState(), slope));
    slope = code.transposedProduct(m_.b, costate, slope);
    AtomMatrix next = code.transposedProduct(m_.cross, iterateInput(), code.product(m_.q, iterateState()));
    next = code.transposedProduct(m_.a, costate, next);
    for (int o = 0; o < static_cast<int>(c_.size()); ++o) {
      if (!restricted(o) || !d_.outputs[at(o)].touchesInput()) continue;
      slope = code.transposedProduct(d_matrix_[at(o)], force(o), slope, true);
      next = code.transposedProduct(c_[at(o)], force(o), next, true);
    }
    next = code.transposedProduct(gain(), slope, next, true);
    const Factor factor = storedFactor();
    AtomMatrix constant = slope;
    code.forwardSubstitute(factor, constant, 0);
    for (int i = 0; i < m_.u; ++i) constant(i, 0) = code.multiply(constant(i, 0), factor.inverse[at(i)]);
    code.backwardSubstitute(factor, constant, 0);
    for (int i = 0; i < m_.u; ++i) code.store("s->ip_constant[k][" + std::to_string(i) + "]", constant(i, 0));
    for (int i = 0; i < m_.z; ++i) code.store("next_c" + std::to_string(i), next(i, 0));
  }

  void writeForward() {
    out_ << "/* Steps of the inputs, and of the outputs that follow from them. */\n"
            "static void qpc_ip_forward(const qpc_tables* t, qpc_solver* s) {\n  (void)t;\n";
    for (int i = 0; i < m_.z; ++i) out_ << "  double next_z" << i << " = 0.0;\n";
    out_ << "  for (int k = 0; k < QPC_HORIZON; ++k) {\n";
    for (int i = 0; i < m_.z; ++i) out_ << "    const double z" << i << " = next_z" << i << ";\n";
    StraightLine code;
    const AtomMatrix z = column("z", m_.z);
    AtomMatrix constant(m_.u, 1);
    for (int i = 0; i < m_.u; ++i) constant(i, 0) = Atom("(-s->ip_constant[k][" + std::to_string(i) + "])");
    const AtomMatrix u = code.product(gain(), z, constant, true);
    const AtomMatrix next = code.product(m_.b, u, code.product(m_.a, z));
    for (int i = 0; i < m_.u; ++i) code.store("s->ip_input[k][" + std::to_string(i) + "]", u(i, 0));
    for (int o = 0; o < static_cast<int>(c_.size()); ++o) {
      if (!restricted(o)) continue;
      const bool touches = d_.outputs[at(o)].touchesInput();
      AtomMatrix y = code.product(c_[at(o)], touches ? z : next);
      if (touches) y = code.product(d_matrix_[at(o)], u, y);
      for (int c = 0; c < y.rows; ++c) {
        code.store("s->output[qpc_output_place[" + std::to_string(o) + "][" + std::to_string(c) + "] + k]", y(c, 0));
      }
    }
    for (int i = 0; i < m_.z; ++i) code.store("next_z" + std::to_string(i), next(i, 0));
    out_ << code.text() << "  }\n}\n";
  }

  AtomMatrix gain() const {
    AtomMatrix k(m_.u, m_.z);
    for (int i = 0; i < m_.u; ++i) {
      for (int j = 0; j < m_.z; ++j) k(i, j) = Atom("s->ip_gain[k][" + std::to_string(i * m_.z + j) + "]");
    }
    return k;
  }

  Factor storedFactor() const {
    Factor factor{AtomMatrix(m_.u, m_.u), {}};
    for (int i = 0; i < m_.u; ++i) {
      factor.inverse.emplace_back("s->ip_pivot[k][" + std::to_string(i) + "]");
      for (int j = 0; j < i; ++j) factor.lower(i, j) = Atom("s->ip_lower[k][" + std::to_string(packed(i, j)) + "]");
    }
    return factor;
  }

  const Description& d_;
  StageBuilder builder_;
  StageMatrices m_;
  std::vector<AtomMatrix> c_, d_matrix_;
  std::vector<bool> pattern_;
  std::ostringstream out_;
};

}  // namespace

std::string writeRiccati(const Description& d, const Structure& s) { return RiccatiWriter(d, s).write(); }

}  // namespace codegen
}  // namespace swarm_planner
