/* ---- Interior point: primal-dual, predictor and corrector (Mehrotra). ----
   Every side has room = sign * value + slack - offset >= 0 with its multiplier, and, if it is soft, slack >= 0 with the
   multiplier reserve = linear + quadratic slack - multiplier. All four are eliminated from Newton's equations. Where
   the penalty has no linear part, slack = multiplier / quadratic follows, which needs no reserve (it is 0). */

enum { QPC_LAMBDA, QPC_ROOM, QPC_SLACK, QPC_RESERVE };

/* What the complementarities are steered to: `centre`; with the second-order terms in the corrector. */
typedef struct {
  double centre;
  int corrected;
} qpc_aim;

/* Sizes of what must vanish, and of the terms that it is made of. */
typedef struct {
  double primal, dual, gap, cost, complementarity;
} qpc_state;

/* Multiplier and slack of a side so that both complementarities are `centre`. */
static void qpc_centre_side(qpc_solver* s, int e, double room, double centre) {
  const double lambda = centre / room;
  double slack = 0.0, reserve = 1.0;
  if (s->side_soft[e] > 0.0) {
    const double free = s->side_linear[e] - lambda, quadratic = s->side_quadratic[e];
    const double root = qpc_root(free * free + 4.0 * quadratic * centre);
    slack = free > 0.0 ? 2.0 * centre / (free + root) : (root - free) / (2.0 * quadratic);
    reserve = centre / slack;
  } else if (s->side_quadratic[e] > 0.0) {
    slack = lambda / s->side_quadratic[e];
    reserve = 0.0;
  }
  s->side_variable[QPC_LAMBDA][e] = lambda;
  s->side_variable[QPC_ROOM][e] = room;
  s->side_variable[QPC_SLACK][e] = slack;
  s->side_variable[QPC_RESERVE][e] = reserve;
}

/* Pulls of the places that are not fixed, from the multipliers. */
static void qpc_collect_pulls(qpc_solver* s) {
  for (int p = 0; p < QPC_PLACES; ++p) s->pull[p] = s->fixed[p] ? s->pull[p] : 0.0;
  for (int e = 0; e < s->side_count; ++e) {
    s->pull[s->side_place[e]] += s->side_sign[e] * s->side_variable[QPC_LAMBDA][e];
  }
}

/* The point that weighs the cost against distances from the feasible points nearest to 0; rooms of at least the
   largest violation there, and multipliers that match the average push of the penalties. 0 if H is not positive
   semidefinite. */
static int qpc_start_cold(const qpc_matrices* m, qpc_solver* s) {
  double room = 1.0, push = 0.0;
  s->regularisation = QPC_LEAST_REGULARISATION;
  qpc_clear(s->position, QPC_VARIABLES);
  qpc_clear(s->pull, QPC_PLACES);
  for (int p = 0; p < QPC_PLACES; ++p) {
    s->weight[p] = s->fixed[p] ? QPC_FIXED_WEIGHT : 0.0;
    s->force[p] = s->fixed[p] ? s->target[p] * QPC_FIXED_WEIGHT : 0.0;
  }
  for (int e = 0; e < s->side_count; ++e) {
    s->weight[s->side_place[e]] = 1.0;
    if (s->side_offset[e] > 0.0) s->force[s->side_place[e]] = s->side_sign[e] * s->side_offset[e];
  }
  for (int j = 0; j < QPC_VARIABLES; ++j) s->dual_residual[j] = s->gradient[j];
  s->wrong_pivot = QPC_WRONG_PIVOT;
  if (!qpc_prepare(m, s)) return 0;
  qpc_respond(m, s);
  for (int j = 0; j < QPC_VARIABLES; ++j) s->position[j] = s->value_step[QPC_ROWS + j];
  for (int p = 0; p < QPC_PLACES; ++p) s->pull[p] = s->fixed[p] ? s->pull_step[p] : 0.0;
  qpc_evaluate_places(m, s->position, s->value);
  for (int e = 0; e < s->side_count; ++e) {
    const double violation = s->side_offset[e] - s->side_sign[e] * s->value[s->side_place[e]];
    room = qpc_larger(room, violation);
    if (violation > 0.0) push += s->side_linear[e] + s->side_quadratic[e] * violation;
  }
  for (int e = 0; e < s->side_count; ++e) {
    const double found = s->side_sign[e] * s->value[s->side_place[e]] - s->side_offset[e];
    qpc_centre_side(s, e, qpc_larger(found, room), room * qpc_larger(1.0, QPC_START_PUSH * push / s->side_count));
  }
  return 1;
}

/* The guess, moved to where all complementarities are the same and small. */
static void qpc_start_warm(const qpc_matrices* m, qpc_solver* s) {
  for (int j = 0; j < QPC_VARIABLES; ++j) {
    s->position[j] = s->warm_x[j] / m->variable_scale[j];
    s->pull[QPC_ROWS + j] = s->warm_bound_multiplier[j] * m->variable_scale[j] * s->cost_scale;
  }
  for (int r = 0; r < QPC_ROWS; ++r) s->pull[r] = s->warm_row_multiplier[r] / m->row_scale[r] * s->cost_scale;
  qpc_evaluate_places(m, s->position, s->value);
  for (int e = 0; e < s->side_count; ++e) {
    const int p = s->side_place[e];
    const double found = s->side_sign[e] * s->value[p] - s->side_offset[e];
    const double lambda = s->side_sign[e] * s->pull[p];
    const double active = qpc_larger(lambda, QPC_WARM_ROOM);
    qpc_centre_side(s, e, lambda > found ? QPC_WARM_CENTRE / active : qpc_larger(found, QPC_WARM_ROOM),
                    QPC_WARM_CENTRE);
  }
}

/* Residuals at the present point, and the weights. */
static qpc_state qpc_look(const qpc_matrices* m, qpc_solver* s) {
  qpc_state state = {0.0, 0.0, 0.0, 0.0, 0.0};
  double terms = 1e-3, off = 0.0; /* off: what the residuals may change the cost by */
  qpc_evaluate_places(m, s->position, s->value);
  qpc_collect_pulls(s);
  qpc_multiply_hessian(m, s->position, s->slope);
  for (int j = 0; j < QPC_VARIABLES; ++j) {
    s->slope[j] *= s->cost_scale;
    s->dual_residual[j] = s->slope[j] + s->gradient[j];
    state.cost += s->position[j] * (0.5 * s->slope[j] + s->gradient[j]);
    terms = qpc_larger(terms, qpc_larger(qpc_magnitude(s->slope[j]), qpc_magnitude(s->gradient[j])));
  }
  qpc_subtract_pull(m, s->pull, s->dual_residual);
  for (int j = 0; j < QPC_VARIABLES; ++j) {
    state.dual = qpc_larger(state.dual, qpc_magnitude(s->dual_residual[j]));
    off += qpc_magnitude(s->dual_residual[j] * s->position[j]);
  }
  for (int p = 0; p < QPC_PLACES; ++p) {
    if (!s->fixed[p]) {
      s->weight[p] = 0.0;
      continue;
    }
    const double scale = qpc_larger(1.0, qpc_magnitude(s->value[p]));
    state.primal = qpc_larger(state.primal, qpc_magnitude(s->target[p] - s->value[p]) / scale);
    off += qpc_magnitude(s->pull[p] * (s->target[p] - s->value[p]));
  }
  for (int e = 0; e < s->side_count; ++e) {
    const int p = s->side_place[e];
    const double lambda = s->side_variable[QPC_LAMBDA][e], room = s->side_variable[QPC_ROOM][e];
    const double slack = s->side_variable[QPC_SLACK][e], reserve = s->side_variable[QPC_RESERVE][e];
    const double scale = qpc_larger(1.0, qpc_magnitude(s->value[p]));
    s->side_residual[e] = s->side_sign[e] * s->value[p] + slack - s->side_offset[e] - room;
    s->side_inverse_reserve[e] = 1.0 / (s->side_quadratic[e] * slack + reserve);
    s->side_inverse_room[e] = 1.0 / (room + lambda * slack * s->side_inverse_reserve[e]);
    s->weight[p] += lambda * s->side_inverse_room[e];
    const double penalty = slack * (s->side_linear[e] + 0.5 * s->side_quadratic[e] * slack);
    state.primal = qpc_larger(state.primal, qpc_magnitude(s->side_residual[e]) / scale);
    state.complementarity += lambda * room + slack * reserve * s->side_soft[e];
    off += qpc_magnitude(lambda * s->side_residual[e]);
    state.cost += penalty;
  }
  state.dual /= terms;
  const double size = qpc_larger(qpc_magnitude(state.cost), QPC_LEAST_COST);
  state.gap = (state.complementarity + off) / size;
  return state;
}

/* Forces at all places. */
static void qpc_set_forces(qpc_solver* s, qpc_aim aim) {
  for (int p = 0; p < QPC_PLACES; ++p) s->force[p] = s->fixed[p] ? (s->target[p] - s->value[p]) * s->weight[p] : 0.0;
  for (int e = 0; e < s->side_count; ++e) {
    const double lambda = s->side_variable[QPC_LAMBDA][e], room = s->side_variable[QPC_ROOM][e];
    double first = aim.centre, second = aim.centre;
    if (aim.corrected) {
      first -= s->side_product[0][e];
      second -= s->side_product[1][e];
    }
    second = second * s->side_soft[e] - s->side_variable[QPC_RESERVE][e] * s->side_variable[QPC_SLACK][e];
    s->side_force[e] = s->side_inverse_room[e] *
                       (first - lambda * (room + s->side_residual[e] + s->side_inverse_reserve[e] * second));
    s->force[s->side_place[e]] += s->side_sign[e] * s->side_force[e];
  }
}

/* Steps of all sides for the places' steps; returns the step, at most 1, that leaves everything
   positive a share of what it is. */
static double qpc_set_directions(qpc_solver* s, qpc_aim aim) {
  double shrink = QPC_STEP_SHARE;
  for (int e = 0; e < s->side_count; ++e) {
    double v[4], d[4];
    const int p = s->side_place[e];
    const double value = s->side_sign[e] * s->value_step[p];
    for (int i = 0; i < 4; ++i) v[i] = s->side_variable[i][e];
    double second = aim.centre - (aim.corrected ? s->side_product[1][e] : 0.0);
    second = second * s->side_soft[e] - v[QPC_RESERVE] * v[QPC_SLACK];
    d[QPC_LAMBDA] = s->side_force[e] - v[QPC_LAMBDA] * s->side_inverse_room[e] * value;
    d[QPC_SLACK] = (v[QPC_SLACK] * d[QPC_LAMBDA] + second) * s->side_inverse_reserve[e];
    d[QPC_ROOM] = value + d[QPC_SLACK] + s->side_residual[e];
    d[QPC_RESERVE] = s->side_soft[e] * (s->side_quadratic[e] * d[QPC_SLACK] - d[QPC_LAMBDA]);
    for (int i = 0; i < 4; ++i) {
      if (-d[i] > shrink * v[i]) shrink = -d[i] / v[i];
      s->side_step[i][e] = d[i];
    }
  }
  return QPC_STEP_SHARE / shrink;
}

static double qpc_clip(double value, double most) { return value > most ? most : value < -most ? -most : value; }

/* Stores the second-order terms of the predictor, up to `most`, as they mislead where they are great; returns the
   complementarity where it leads. */
static double qpc_predict(qpc_solver* s, double step, double most) {
  double sum = 0.0;
  for (int e = 0; e < s->side_count; ++e) {
    double v[4];
    for (int i = 0; i < 4; ++i) v[i] = s->side_variable[i][e] + step * s->side_step[i][e];
    sum += v[QPC_LAMBDA] * v[QPC_ROOM] + v[QPC_SLACK] * v[QPC_RESERVE] * s->side_soft[e];
    s->side_product[0][e] = qpc_clip(s->side_step[QPC_LAMBDA][e] * s->side_step[QPC_ROOM][e], most);
    s->side_product[1][e] = qpc_clip(s->side_step[QPC_SLACK][e] * s->side_step[QPC_RESERVE][e], most);
  }
  return sum;
}

static void qpc_take_step(qpc_solver* s, double step) {
  for (int j = 0; j < QPC_VARIABLES; ++j) s->position[j] += step * s->value_step[QPC_ROWS + j];
  for (int p = 0; p < QPC_PLACES; ++p) {
    if (s->fixed[p]) s->pull[p] += step * s->pull_step[p];
  }
  for (int i = 0; i < 4; ++i) {
    for (int e = 0; e < s->side_count; ++e) s->side_variable[i][e] += step * s->side_step[i][e];
  }
}

/* Farkas: multipliers of hard rows and bounds that cancel out but whose offsets do not prove that no point meets them,
   at least none of a size that the numbers allow. */
static int qpc_proves_infeasible(const qpc_matrices* m, const qpc_solver* s) {
  double pull[QPC_PLACES], rest[QPC_VARIABLES];
  double growth = 0.0, size = 1.0, largest = 0.0;
  for (int p = 0; p < QPC_PLACES; ++p) {
    pull[p] = s->fixed[p] ? s->pull[p] : 0.0;
    growth += s->fixed[p] ? s->pull[p] * s->target[p] : 0.0;
  }
  for (int e = 0; e < s->side_count; ++e) {
    if (s->side_quadratic[e] > 0.0) continue;
    pull[s->side_place[e]] += s->side_sign[e] * s->side_variable[QPC_LAMBDA][e];
    growth += s->side_variable[QPC_LAMBDA][e] * s->side_offset[e];
  }
  qpc_clear(rest, QPC_VARIABLES);
  qpc_subtract_pull(m, pull, rest);
  for (int j = 0; j < QPC_VARIABLES; ++j) {
    largest = qpc_larger(largest, qpc_magnitude(rest[j]));
    size = qpc_larger(size, qpc_magnitude(s->position[j]));
  }
  return growth > 0.0 && largest * size * QPC_CERTAINTY < growth;
}

/* A direction that costs nothing in H, meets no bound and falls. */
static int qpc_proves_no_minimum(const qpc_solver* s) {
  double size = 0.0, fall = 0.0, bend = 0.0, blocked = 0.0;
  for (int j = 0; j < QPC_VARIABLES; ++j) {
    size = qpc_larger(size, qpc_magnitude(s->position[j]));
    fall -= s->gradient[j] * s->position[j];
    bend = qpc_larger(bend, qpc_magnitude(s->slope[j]));
  }
  if (size < QPC_CERTAINTY) return 0;
  for (int p = 0; p < QPC_PLACES; ++p) {
    if (s->fixed[p]) blocked = qpc_larger(blocked, qpc_magnitude(s->value[p] - s->target[p]));
  }
  for (int e = 0; e < s->side_count; ++e) {
    blocked = qpc_larger(blocked, s->side_offset[e] - s->side_sign[e] * s->value[s->side_place[e]]);
  }
  return fall > 0.0 && bend * size < 1e-2 * fall && blocked * QPC_CERTAINTY < size;
}

/* Far from the optimum steps are kept short where nothing else limits them, close to it they are to be exact: more so
   where residuals do not vanish as fast as the last step promised. */
static void qpc_regularise(qpc_solver* s, double complementarity, double taken, int slow) {
  double share = QPC_REGULARISATION * complementarity;
  if (slow) s->damping *= 0.1;
  if (taken < QPC_SHORT_STEP && s->damping < 1.0) s->damping *= 10.0;
  if (!(share > QPC_LEAST_REGULARISATION)) share = QPC_LEAST_REGULARISATION;
  if (share > QPC_MOST_REGULARISATION) share = QPC_MOST_REGULARISATION;
  s->regularisation = qpc_larger(s->damping * share, QPC_NO_REGULARISATION);
}

/* The step is a direction in which the cost bends down: H is not positive semidefinite. */
static int qpc_bends_down(const qpc_matrices* m, const qpc_solver* s) {
  double bend[QPC_VARIABLES];
  const double* step = s->value_step + QPC_ROWS;
  double sum = 0.0, size = 0.0;
  qpc_multiply_hessian(m, step, bend);
  for (int j = 0; j < QPC_VARIABLES; ++j) {
    sum += step[j] * bend[j];
    size += step[j] * step[j];
  }
  return sum < -QPC_WRONG_PIVOT * size;
}

/* From the present point to the optimum. */
static int qpc_iterate(const qpc_matrices* m, qpc_solver* s) {
  int pairs = 0;
  double before = QPC_UNBOUNDED, taken = 1.0, least_centre = 0.0;
  s->damping = 1.0;
  s->wrong_pivot = QPC_UNBOUNDED; /* with great weights, a wrong sign is rounding */
  for (int e = 0; e < s->side_count; ++e) pairs += s->side_soft[e] > 0.0 ? 2 : 1;
  for (int step = 0;; ++step) {
    const qpc_state state = qpc_look(m, s);
    const double residual = qpc_larger(state.primal, qpc_larger(state.dual, state.gap));
    if (!qpc_is_finite(residual + state.cost)) return QPC_BAD_DATA;
    s->residual = residual;
    s->objective = state.cost / s->cost_scale;
    if (residual <= s->tolerance) return QPC_SOLVED;
    if (step >= 3 && qpc_proves_infeasible(m, s)) return QPC_INFEASIBLE;
    if (step >= 3 && qpc_proves_no_minimum(s)) return QPC_NO_MINIMUM;
    if (step == QPC_MAX_ITERATIONS) return QPC_CAP;
    ++s->iterations;
    const double infeasibility = qpc_larger(state.primal, state.dual);
    qpc_regularise(s, pairs > 0 ? state.complementarity / pairs : 0.0, taken,
                   taken > 0.9 && infeasibility > 0.3 * before && infeasibility > s->tolerance);
    before = infeasibility;
    if (step == 0 && pairs > 0) {
      least_centre = QPC_LEAST_CENTRE * state.complementarity / (pairs * qpc_larger(infeasibility, s->tolerance));
    }
    if (!qpc_prepare(m, s)) return QPC_NOT_CONVEX;
    const qpc_aim straight = {0.0, 0};
    qpc_set_forces(s, straight);
    qpc_respond(m, s);
    double longest = qpc_set_directions(s, straight);
    if (pairs > 0) {
      double left = qpc_predict(s, longest, QPC_MOST_PRODUCT * state.complementarity / pairs) / state.complementarity;
      if (left > 1.0) left = 1.0;
      const double centre = left * left * left * state.complementarity / pairs;
      const qpc_aim aim = {qpc_larger(centre, least_centre * infeasibility), 1};
      qpc_set_forces(s, aim);
      qpc_respond(m, s);
      longest = qpc_set_directions(s, aim);
      if (longest < QPC_SHORT_STEP && infeasibility < QPC_NEARLY_FEASIBLE) {
        /* Towards the centre, without the second-order terms, there is more room. */
        const qpc_aim centred = {0.5 * state.complementarity / pairs, 0};
        qpc_set_forces(s, centred);
        qpc_respond(m, s);
        longest = qpc_set_directions(s, centred);
      }
    }
    if (qpc_bends_down(m, s)) return QPC_NOT_CONVEX;
    taken = longest;
    qpc_take_step(s, taken);
  }
}
