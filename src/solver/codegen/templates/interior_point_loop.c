/* ---- The interior-point iterations. ---- */

/* Complementarity at the start, in units of the cost. */
#define QPC_IP_START 1.0

static double qpc_magnitude(double value) { return value < 0.0 ? -value : value; }

/* Places one row's variables in the interior; returns by how much its equation is violated. */
static double qpc_ip_place(const qpc_tables* t, qpc_solver* s, int e, double value, double offset, int penalty) {
  const double linear = t->penalty_linear[penalty], compliance = t->compliance[penalty];
  const double room = value - offset;
  s->ip_slack[e] = 0.0;
  s->ip_reserve[e] = 1.0;
  s->ip_quadratic[e] = 0.0;
  s->ip_lambda[e] = 0.0;
  s->ip_room[e] = room;
  for (int i = 0; i < 4; ++i) s->ip_step[i][e] = 0.0;
  if (offset <= -0.5 * QPC_UNBOUNDED) return 0.0;
  if (compliance > 0.0) {
    const double least = 2.0 * QPC_IP_START / (linear + 1.0);
    s->ip_quadratic[e] = 1.0 / compliance;
    s->ip_slack[e] = least + (room < least ? least - room : 0.0);
    s->ip_room[e] = room + s->ip_slack[e];
    s->ip_lambda[e] = QPC_IP_START / s->ip_room[e];
    s->ip_reserve[e] = linear + s->ip_quadratic[e] * s->ip_slack[e] - s->ip_lambda[e];
    if (s->ip_reserve[e] > 0.1 * s->ip_lambda[e]) return 0.0;
    s->ip_lambda[e] = 0.5 * (linear + s->ip_quadratic[e] * s->ip_slack[e]);
    s->ip_reserve[e] = s->ip_lambda[e];
    return 0.0;
  }
  const double size = qpc_magnitude(room);
  s->ip_room[e] = size > 0.1 ? size : 0.1;
  s->ip_lambda[e] = QPC_IP_START / s->ip_room[e];
  return qpc_magnitude(s->ip_room[e] - room);
}

/* Rows and bounds at the problem's optimum without them; the pairs' number, and the largest residual. */
static int qpc_ip_begin(const qpc_tables* t, qpc_solver* s, double* gap, double* residual) {
  int pairs = 0;
  *gap = 0.0;
  *residual = 0.0;
  for (int group = 0; group < s->group_count; ++group) {
    const int o = s->group_output[group], index = s->group_index[group];
    for (int i = 0; i < QPC_ROUND_UP(s->group_rows[group], QPC_WIDTH); ++i) {
      const int slot = s->group_slot[group] + i;
      double value = 0.0;
      for (int c = 0; c < QPC_COMPONENTS; ++c) {
        value += s->row_normal[c][slot] * s->output[qpc_output_place[o][c] + (index < 0 ? i : index)];
      }
      if (s->row_penalty[slot] > QPC_PENALTIES) return -1;
      const double off = qpc_ip_place(t, s, slot, value, s->row_offset[slot], s->row_penalty[slot]);
      *residual = off > *residual ? off : *residual;
      *gap += s->ip_lambda[slot] * s->ip_room[slot] + s->ip_slack[slot] * s->ip_reserve[slot];
      pairs += (s->ip_lambda[slot] > 0.0) + (s->ip_slack[slot] > 0.0);
    }
  }
  for (int place = 0; place < QPC_BLOCKS * QPC_POINTS_PADDED; ++place) {
    const int point = place % QPC_POINTS_PADDED;
    const int penalty = point < QPC_POINTS ? qpc_bound_penalty[place / QPC_POINTS_PADDED][point / QPC_HORIZON] : 0;
    for (int side = 0; side < 2; ++side) {
      const int e = QPC_ROW_SLOTS + place + side * QPC_BLOCKS * QPC_POINTS_PADDED;
      const double value = side ? -s->output[place] : s->output[place];
      const double off = qpc_ip_place(t, s, e, value, side ? -s->upper[place] : s->lower[place], penalty);
      *residual = off > *residual ? off : *residual;
      *gap += s->ip_lambda[e] * s->ip_room[e] + s->ip_slack[e] * s->ip_reserve[e];
      pairs += (s->ip_lambda[e] > 0.0) + (s->ip_slack[e] > 0.0);
    }
  }
  return pairs;
}

static void qpc_ip_solve(const qpc_tables* t, qpc_solver* s) {
  qpc_ip_backward(t, s);
  qpc_ip_forward(t, s);
}

/* Moves inputs and outputs a part of the way to those just solved for. */
static void qpc_ip_move(qpc_solver* s, double step) {
  double* u = &s->ip_input[0][0];
  const double* target = &s->u[0][0];
  for (int i = 0; i < QPC_HORIZON * QPC_INPUTS; ++i) u[i] += step * (target[i] - u[i]);
}

static void qpc_ip_list(qpc_solver* s, int e, int id, double step) {
  const double lambda = s->ip_lambda[e] + step * s->ip_step[0][e], room = s->ip_room[e] + step * s->ip_step[1][e];
  if (!(lambda > room) || s->active_count == QPC_MAX_ACTIVE) return;
  s->active_id[s->active_count] = id;
  s->multiplier[s->active_count] = lambda;
  s->slack[s->active_count++] = s->ip_slack[e] + step * s->ip_step[2][e];
}

/* The result: inputs, and the rows and bounds whose multiplier exceeds their room, as far as there is space. */
static void qpc_ip_collect(qpc_solver* s, double step) {
  for (int k = 0; k < QPC_HORIZON; ++k) {
    for (int j = 0; j < QPC_INPUTS; ++j) s->u[k][j] = s->ip_input[k][j];
  }
  s->active_count = 0;
  for (int group = 0; group < s->group_count; ++group) {
    for (int i = 0; i < s->group_rows[group]; ++i) {
      qpc_ip_list(s, s->group_slot[group] + i, s->group_slot[group] + i, step);
    }
  }
  for (int place = 0; place < QPC_BLOCKS * QPC_POINTS_PADDED; ++place) {
    qpc_ip_list(s, QPC_ROW_SLOTS + place, QPC_FIRST_BOUND_ID + 2 * place, step);
    qpc_ip_list(s, QPC_ROW_SLOTS + QPC_BLOCKS * QPC_POINTS_PADDED + place, QPC_FIRST_BOUND_ID + 2 * place + 1, step);
  }
}

static int qpc_interior_point(const qpc_tables* t, qpc_solver* s) {
  double gap, residual, step = 0.0, linear, quadratic;
  for (int i = 0; i < QPC_BLOCKS * QPC_POINTS_PADDED; ++i) s->output[i] = s->free_output[i];
  qpc_order_inputs(s, s->ip_input);
  const int pairs = qpc_ip_begin(t, s, &gap, &residual);
  if (pairs < 0 || !qpc_is_finite(gap)) return QPC_BAD_DATA;
  for (s->iterations = 0; s->iterations < QPC_IP_MAX_STEPS; ++s->iterations) {
    if (gap <= s->tolerance && residual <= s->tolerance) {
      qpc_ip_collect(s, step);
      return QPC_SOLVED;
    }
    qpc_ip_forces(s, step, (qpc_aim){0.0, 0});
    if (!qpc_ip_factor(t, s)) return QPC_CAP;
    qpc_ip_solve(t, s);
    const double affine = qpc_ip_directions(s, (qpc_aim){0.0, 0}, &linear, &quadratic);
    double left = (gap + affine * (linear + affine * quadratic)) / gap;
    left = left > 0.0 ? left : 0.0;
    const double centre = left * left * left * gap / pairs;
    qpc_ip_forces(s, 0.0, (qpc_aim){centre, 1});
    qpc_ip_solve(t, s);
    const double longest = qpc_ip_directions(s, (qpc_aim){centre, 1}, &linear, &quadratic);
    step = longest < 1.0 ? 0.995 * longest : 1.0;
    qpc_ip_move(s, step);
    gap += step * (linear + step * quadratic);
    residual *= 1.0 - step;
    if (!qpc_is_finite(gap)) return QPC_CAP;
  }
  return QPC_CAP;
}
