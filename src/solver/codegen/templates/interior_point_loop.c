/* ---- The interior-point iterations. ---- */

#define QPC_IP_MAX_STEPS 60

/* Places entry e's variables in the interior, given n . y. */
static void qpc_ip_place_variables(qpc_solver* s, int e, double value, double linear, double compliance) {
  const double room = value - s->ip_offset[e];
  double slack = 0.0, reserve = 1.0, lambda, start = room;
  if (compliance > 0.0) {
    /* Rows that are far off start with room in proportion: one that is much closer to its end than the others holds
       all of them up. */
    const double usual = 2.0 * QPC_IP_START / (linear + 1.0);
    const double least = room < -10.0 * usual ? -0.1 * room : usual;
    slack = least + (room < least ? least - room : 0.0);
    start = room + slack;
    const double full = linear + slack / compliance;
    lambda = QPC_IP_START / start < 0.5 * full ? QPC_IP_START / start : 0.5 * full;
    reserve = full - lambda;
  } else {
    const double size = qpc_magnitude(room);
    start = size > 0.1 ? size : 0.1;
    lambda = QPC_IP_START / start;
  }
  s->ip_quadratic[e] = compliance > 0.0 ? 1.0 / compliance : 0.0;
  s->ip_variable[QPC_LAMBDA][e] = lambda;
  s->ip_variable[QPC_ROOM][e] = start;
  s->ip_variable[QPC_SLACK][e] = slack;
  s->ip_variable[QPC_RESERVE][e] = reserve;
  for (int i = 0; i < 4; ++i) s->ip_step[i][e] = 0.0;
  s->ip_residual[e] = room + slack - start;
}

/* Makes a hard row soft, by a penalty that is exact: the multipliers of hard rows that leave no room between them may be
   as large as they like, which the method would try, but need not be much larger than what moves the inputs as far as
   the optimum is away. */
static void qpc_ip_soften(const qpc_solver* s, int e, qpc_row* row) {
  row->linear = 1e4 * qpc_root(s->ip_reach / s->ip_self[e]);
  row->compliance = 1e-4 * s->ip_self[e];
}

/* Gives the method one more row or bound, which the scan then no longer sees. */
static int qpc_ip_take(const qpc_tables* t, qpc_solver* s, int id) {
  qpc_row row;
  const int e = s->ip_count;
  if (!qpc_load_row(t, s, id, &row)) return 0;
  if (row.offset <= -0.5 * QPC_UNBOUNDED) return 1;
  s->ip_self[e] = qpc_gram_self(t, &row);
  s->ip_hard[e] = row.compliance == 0.0;
  if (s->ip_hard[e] && s->ip_self[e] <= 0.0) return 1; /* no input moves it: the scan says whether it holds */
  s->ip_id[e] = id;
  s->ip_group[0][e] = row.output;
  s->ip_group[1][e] = row.index;
  for (int c = 0; c < QPC_COMPONENTS; ++c) {
    s->ip_place[c][e] = row.place[c];
    s->ip_normal[c][e] = row.normal[c];
  }
  s->ip_offset[e] = row.offset;
  if (s->ip_hard[e] && s->ip_give > 0.0) qpc_ip_soften(s, e, &row);
  /* Until the variables are placed, the penalty stands in for them. */
  s->ip_variable[QPC_ROOM][e] = row.linear;
  s->ip_variable[QPC_SLACK][e] = row.compliance;
  s->ip_count = e + 1;
  qpc_mask_row(s, id, 1, 0.0);
  return 1;
}

/* Size of a step along the row in the metric of the Hessian: an upper bound of its Gram entry. */
QPC_FUNCTION double qpc_ip_gram_diagonal(const qpc_tables* t, int output, int c, int index) {
  const int place = qpc_output_place[output][c] + index;
  const int point = place % QPC_POINTS_PADDED;
  return (QPC_ALIGNED ? 1.0 : QPC_COMPONENTS) *
         t->gram[qpc_class_of_block[place / QPC_POINTS_PADDED]][point][point];
}

/* Goes through all rows and bounds at s->output. With `take`: gives the method those whose room, in units of what a
   unit step in the Hessian's metric moves them, is at most `reach` (squared). Otherwise returns the largest violation
   in these units, squared; < 0: a row is bad. */
static double qpc_ip_screen(const qpc_tables* t, qpc_solver* s, int take, double reach) {
  double largest = 0.0;
  for (int group = 0; group < s->group_count; ++group) {
    const int o = s->group_output[group], index = s->group_index[group];
    for (int i = 0; i < s->group_rows[group]; i += QPC_WIDTH) {
      const qpc_vector violation = qpc_row_violation(s, group, i);
      qpc_vector size = {0};
      for (int c = 0; c < QPC_COMPONENTS; ++c) {
        const qpc_vector n = QPC_LOAD(&s->row_normal[c][s->group_slot[group] + i]);
        qpc_vector diagonal = QPC_BROADCAST(qpc_ip_gram_diagonal(t, o, c, index >= 0 ? index : i));
        for (int l = 1; l < QPC_WIDTH && index < 0; ++l) {
          diagonal[l] = qpc_ip_gram_diagonal(t, o, c, i + l < QPC_HORIZON ? i + l : 0);
        }
        size += n * n * diagonal;
      }
      const qpc_vector square = violation * violation;
      for (int l = 0; l < QPC_WIDTH && i + l < s->group_rows[group]; ++l) {
        if (!take && violation[l] > 0.0 && size[l] > 0.0 && square[l] > largest * size[l]) largest = square[l] / size[l];
        if (!take || (violation[l] < 0.0 && square[l] > reach * size[l])) continue;
        if (!qpc_ip_take(t, s, s->group_slot[group] + i + l)) return -1.0;
      }
    }
  }
  for (int place = 0; place < QPC_BLOCKS * QPC_POINTS_PADDED && QPC_BOUND_RANGES > 0; ++place) {
    const int block = place / QPC_POINTS_PADDED, point = place % QPC_POINTS_PADDED;
    if (point >= QPC_POINTS) continue;
    const double size = t->gram[qpc_class_of_block[block]][point][point];
    for (int upper = 0; upper < 2; ++upper) {
      const double v = upper ? s->output[place] - s->upper[place] : s->lower[place] - s->output[place];
      if (!take && v > 0.0 && size > 0.0 && v * v > largest * size) largest = v * v / size;
      if (!take || (v < 0.0 && v * v > reach * size)) continue;
      if (!qpc_ip_take(t, s, QPC_FIRST_BOUND_ID + 2 * place + upper)) return -1.0;
    }
  }
  return largest;
}

/* All variables of all rows, at the outputs without rows; the number of complementarities. */
static int qpc_ip_begin(qpc_solver* s, double* gap) {
  int pairs = 0;
  *gap = 0.0;
  for (int e = 0; e < s->ip_count; ++e) {
    double value = 0.0;
    for (int c = 0; c < QPC_COMPONENTS; ++c) value += s->ip_normal[c][e] * s->free_output[s->ip_place[c][e]];
    const double linear = s->ip_variable[QPC_ROOM][e], compliance = s->ip_variable[QPC_SLACK][e];
    qpc_ip_place_variables(s, e, value, linear, compliance);
    *gap += s->ip_variable[QPC_LAMBDA][e] * s->ip_variable[QPC_ROOM][e];
    *gap += s->ip_variable[QPC_SLACK][e] * s->ip_variable[QPC_RESERVE][e];
    pairs += compliance > 0.0 ? 2 : 1;
  }
  for (int e = s->ip_count; e < QPC_ROUND_UP(s->ip_count, QPC_WIDTH); ++e) {
    /* Fills up the last vector: never moves, whatever the aim. */
    for (int i = 0; i < 4; ++i) s->ip_variable[i][e] = i == QPC_LAMBDA || i == QPC_SLACK ? 0.0 : 1.0;
    s->ip_variable[QPC_ROOM][e] = QPC_UNBOUNDED;
    for (int i = 0; i < 4; ++i) s->ip_step[i][e] = 0.0;
    s->ip_quadratic[e] = 0.0;
    s->ip_self[e] = 0.0;
    s->ip_offset[e] = -QPC_UNBOUNDED;
    s->ip_residual[e] = 0.0;
    s->ip_value[e] = 0.0;
  }
  return pairs;
}

static void qpc_ip_solve(const qpc_tables* t, qpc_solver* s) {
  qpc_ip_backward(t, s);
  qpc_ip_forward(t, s);
}

/* Takes a step of inputs, states and outputs. */
static void qpc_ip_move(const qpc_tables* t, qpc_solver* s, double step) {
  for (int k = 0; k < QPC_HORIZON; ++k) {
    for (int j = 0; j < QPC_INPUTS; ++j) s->u[k][j] += step * s->ip_input[k][j];
  }
  qpc_roll_out(t, s);
  for (int i = 0; i < QPC_BLOCKS * QPC_POINTS_PADDED; i += QPC_WIDTH) {
    QPC_STORE(&s->ip_output[i], QPC_LOAD(&s->ip_output[i]) + QPC_LOAD(&s->output[i]) * step);
  }
}

/* What the quadratic terms cost at the start, where they have not been balanced. */
static double qpc_ip_quadratic_cost(const qpc_solver* s) {
  double cost = 0.0;
  for (int i = 0; i < s->quadratic_count; ++i) {
    double off = s->quadratic_offset[i];
    for (int c = 0; c < QPC_COMPONENTS; ++c) {
      off -= s->quadratic_normal[i][c] *
             s->free_output[qpc_output_place[s->quadratic_output[i]][c] + s->quadratic_index[i]];
    }
    cost += 0.5 * s->quadratic_weight[i] * off * off;
  }
  return cost;
}

/* Where the iteration is: the duality gap, the rows' largest residual and what all of them cost, and what the multipliers
   at the start and the quadratic terms still lack to be in balance with the cost, which shrinks with every step. */
typedef struct {
  int pairs;
  double gap, residual, price, unbalanced;
} qpc_progress;

/* Predictor and corrector; the length of the step, which is not yet taken. < 0: the recursion has run out of digits. */
static double qpc_ip_newton(const qpc_tables* t, qpc_solver* s, const qpc_progress* p) {
  double linear, quadratic;
  qpc_ip_pulls(s, (qpc_aim){0.0, 0});
  qpc_ip_gather(s, (qpc_aim){0.0, 0});
  if (!qpc_ip_factor(t, s)) return -1.0;
  qpc_ip_solve(t, s);
  double affine = qpc_ip_directions(s, (qpc_aim){0.0, 0}, &linear, &quadratic);
  affine = affine < 1.0 ? affine : 1.0;
  double left = p->pairs > 0 ? (p->gap + affine * (linear + affine * quadratic)) / p->gap : 0.0;
  left = left > 0.0 ? left * left * left * p->gap : 0.0;
  /* No closer to the boundary than asked for, or than the residuals are: from there no step leads on. */
  const double least = 0.1 * (s->tolerance > p->price ? s->tolerance : p->price);
  if (left < least) left = least;
  const double centre = p->pairs > 0 ? left / p->pairs : 0.0;
  qpc_ip_pulls(s, (qpc_aim){centre, 1});
  qpc_ip_gather(s, (qpc_aim){centre, 1});
  qpc_ip_solve(t, s);
  const double longest = qpc_ip_directions(s, (qpc_aim){centre, 1}, &linear, &quadratic);
  return QPC_IP_FRACTION * longest < 1.0 ? QPC_IP_FRACTION * longest : 1.0;
}

/* The optimum with the rows that the method was given. */
static int qpc_ip_iterate(const qpc_tables* t, qpc_solver* s) {
  qpc_progress p;
  double step = 0.0, give = s->ip_give;
  for (int i = 0; i < QPC_BLOCKS * QPC_POINTS_PADDED; ++i) s->ip_output[i] = s->free_output[i];
  for (int i = 0; i < QPC_BLOCKS * QPC_POINTS_PADDED; ++i) s->output[i] = 0.0; /* steps, from here on */
  qpc_order_inputs((const double(*)[QPC_RESPONSE_PADDED])s->free_input, s->u);
  qpc_roll_out(t, s);
  p.pairs = qpc_ip_begin(s, &p.gap);
  p.unbalanced = p.gap + qpc_ip_quadratic_cost(s);
  /* No more can be asked than the digits of what the start was away from the optimum; fewer once they have run out. */
  const double attainable = s->tolerance + (give < 1e-9 ? 1e-12 : 1e-9) * p.unbalanced;
  for (int steps = 0; steps < QPC_IP_MAX_STEPS; ++steps, ++s->iterations) {
    p.gap = qpc_ip_advance(s, step, give, &p.residual, &p.price);
    s->gap = p.gap + p.unbalanced + p.price;
    if (!qpc_is_finite(s->gap)) return QPC_CAP;
    if (s->gap <= s->tolerance && p.residual <= s->tolerance) return QPC_SOLVED;
    step = qpc_ip_newton(t, s, &p);
    if (step < 0.0) break;
    if (p.gap + p.unbalanced <= p.price) give *= 0.1; /* residuals of rows that depend on each other are what is left */
    qpc_ip_move(t, s, step);
    p.unbalanced *= 1.0 - step;
  }
  return s->gap <= attainable && p.residual <= attainable ? QPC_SOLVED : QPC_CAP;
}

/* Shows the scan all rows again. */
static void qpc_ip_release(qpc_solver* s) {
  for (int e = 0; e < s->ip_count; ++e) qpc_mask_row(s, s->ip_id[e], 0, s->ip_offset[e]);
  s->ip_count = 0;
}

/* The result: besides the inputs, the rows and bounds whose multiplier exceeds their room, as far as there is space.
   0 if a hard row has slack. */
static int qpc_ip_collect(qpc_solver* s, double row_tolerance) {
  s->active_count = 0;
  for (int e = 0; e < s->ip_count; ++e) {
    const double slack = s->ip_variable[QPC_SLACK][e];
    if (s->ip_hard[e] && slack > row_tolerance) return 0;
    if (!(s->ip_variable[QPC_LAMBDA][e] > s->ip_variable[QPC_ROOM][e]) || s->active_count == QPC_MAX_ACTIVE) continue;
    s->active_id[s->active_count] = s->ip_id[e];
    s->multiplier[s->active_count] = s->ip_variable[QPC_LAMBDA][e];
    s->slack[s->active_count++] = s->ip_hard[e] ? 0.0 : slack;
  }
  return 1;
}

/* Rows that the optimum cannot reach need not take part: a row moves by no more than the square root of its Gram
   entry times the distance of the optimum from the one without rows, in the Hessian's metric. That distance is guessed
   from the row that needs most of it; a scan of all rows says whether the guess was right, and the last round takes
   every row. */
static int qpc_interior_point(const qpc_tables* t, qpc_solver* s, double tolerance) {
  const double row_tolerance = 0.01 * s->tolerance + tolerance;
  double violation, reach = 0.0;
  for (int i = 0; i < QPC_BLOCKS * QPC_POINTS_PADDED; ++i) s->output[i] = s->free_output[i];
  s->iterations = 0;
  s->ip_count = 0;
  const double distance = qpc_ip_screen(t, s, 0, 0.0);
  s->ip_reach = distance;
  for (int round = 0; round < 5; ++round) {
    reach = round == 0 ? distance : round == 1 ? 16.0 * distance : QPC_UNBOUNDED;
    s->ip_give = round < 3 ? 0.0 : round == 3 ? 1e-12 : 1e-9;
    for (int i = 0; i < QPC_BLOCKS * QPC_POINTS_PADDED; ++i) s->output[i] = s->free_output[i];
    if (distance < 0.0 || qpc_ip_screen(t, s, 1, reach) < 0.0) {
      qpc_ip_release(s);
      return QPC_BAD_DATA;
    }
    int status = qpc_ip_iterate(t, s);
    if (status == QPC_SOLVED) {
      for (int i = 0; i < QPC_BLOCKS * QPC_POINTS_PADDED; ++i) s->output[i] = s->ip_output[i];
      if (qpc_scan(s, row_tolerance, &violation) >= 0) status = QPC_CAP;
    }
    if (status == QPC_SOLVED && !qpc_ip_collect(s, row_tolerance)) status = QPC_CAP;
    qpc_ip_release(s);
    if (status == QPC_SOLVED) return status;
  }
  return QPC_CAP;
}
