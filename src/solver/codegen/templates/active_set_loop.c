/* ---- The active-set iterations. ---- */

/* A Schur complement below this, relative to the row's own Gram entry, counts as linear dependence. */
#define QPC_DEPENDENT 1e-11

/* direction = inverse_gram column; returns the row's curvature left over by the working set. */
static double qpc_project(qpc_solver* s, double self) {
  qpc_multiply_inverse(s, s->column, s->direction);
  double curvature = self;
  for (int i = 0; i < s->active_count; ++i) curvature -= s->column[i] * s->direction[i];
  return curvature;
}

static void qpc_step(qpc_solver* s, const double* rate, double step) {
  for (int i = 0; i < s->active_count; i += QPC_WIDTH) {
    QPC_STORE(&s->lambda[i], QPC_LOAD(&s->lambda[i]) - QPC_LOAD(&rate[i]) * step);
  }
}

/* Entry i has reached an end of its multiplier's range: it leaves, or changes part. 0 if it should become rigid but
   the working set already holds its direction. */
static int qpc_pass_edge(qpc_solver* s, int i, int at_most) {
  s->lambda[i] = at_most ? s->most[i] : s->least[i];
  if (!at_most && s->least[i] == 0.0) {
    qpc_remove(s, i);
    return 1;
  }
  return qpc_change_part(s, i);
}

/* Entry i should become rigid, at the multiplier where its penalty bends, but depends on the other entries. Its
   multiplier is handed over to them, which changes neither outputs nor dual objective, until it is 0 or another entry
   leaves or becomes flexible. 0 if that does not come to an end. */
static int qpc_hand_over(const qpc_tables* t, qpc_solver* s, int i) {
  qpc_row row;
  double rate[QPC_ACTIVE_PADDED];
  double lambda = s->lambda[i];
  const int id = s->active_id[i];
  qpc_remove(s, i);
  if (!qpc_load_row(t, s, id, &row)) return 0;
  const double self = qpc_gram_self(t, &row);
  for (int tries = 0; tries <= 2 * QPC_MAX_ACTIVE; ++tries) {
    int blocking;
    qpc_gram_column(t, s, &row);
    const double curvature = qpc_project(s, self);
    if (curvature > 1e-9 * self) {
      qpc_append(s, &row, lambda, 0, curvature);
      return 1;
    }
    for (int j = 0; j < QPC_ROUND_UP(s->active_count, QPC_WIDTH); ++j) rate[j] = -s->direction[j];
    const double step = qpc_longest_step(s, rate, &blocking);
    if (blocking < 0 || step >= lambda) {
      qpc_step(s, rate, lambda);
      return 1;
    }
    qpc_step(s, rate, step);
    lambda -= step;
    if (!qpc_pass_edge(s, blocking, rate[blocking] < 0.0)) return 0;
  }
  return 0;
}

/* Adds a violated row: its multiplier grows from 0 until the row holds, past every change of the working set on the
   way. */
static int qpc_enter(const qpc_tables* t, qpc_solver* s, const qpc_row* row, double violation) {
  const double self = qpc_gram_self(t, row);
  double lambda = 0.0;
  int soft = row->linear <= 0.0;
  qpc_gram_column(t, s, row);
  while (s->iterations < QPC_MAX_CHANGES) {
    int blocking;
    double curvature = qpc_project(s, self);
    if (curvature < QPC_DEPENDENT * self) curvature = 0.0;
    if (soft) curvature += row->compliance;
    const double full = curvature > 0.0 ? violation / curvature : QPC_UNBOUNDED;
    const double bend = soft ? QPC_UNBOUNDED : row->linear - lambda;
    const double longest = qpc_longest_step(s, s->direction, &blocking);
    ++s->iterations;
    if (full <= longest && full <= bend && full < QPC_UNBOUNDED) {
      if (s->active_count == QPC_MAX_ACTIVE) return QPC_CAP;
      qpc_step(s, s->direction, full);
      qpc_append(s, row, lambda + full, soft, curvature);
      return QPC_SOLVED;
    }
    if (bend < QPC_UNBOUNDED && bend <= longest) {
      qpc_step(s, s->direction, bend);
      lambda = row->linear;
      violation -= bend * curvature;
      soft = 1;
      continue;
    }
    if (blocking < 0) return QPC_INFEASIBLE;
    qpc_step(s, s->direction, longest);
    lambda += longest;
    violation -= longest * curvature;
    const int at_most = s->direction[blocking] < 0.0;
    if (!qpc_pass_edge(s, blocking, at_most)) {
      if (!qpc_hand_over(t, s, blocking)) return QPC_CAP;
      qpc_gram_column(t, s, row);
    }
  }
  return QPC_CAP;
}

/* Largest residual of the working set's equations at the present outputs, less what the digits of their terms allow;
   `column` holds them all. */
static double qpc_residual(qpc_solver* s) {
  double largest = 0.0;
  for (int i = 0; i < s->active_count; ++i) {
    double r = s->target[i] - s->flexibility[i] * s->lambda[i];
    for (int c = 0; c < QPC_COMPONENTS; ++c) r -= s->normal[c][i] * s->output[s->point[c][i]];
    s->column[i] = r;
    const double size = (r < 0.0 ? -r : r) - 1e-14 * (s->target[i] < 0.0 ? -s->target[i] : s->target[i]);
    if (size > largest) largest = size;
  }
  for (int i = s->active_count; i < QPC_ROUND_UP(s->active_count, QPC_WIDTH); ++i) s->column[i] = 0.0;
  return largest;
}

/* Moves the multipliers of a guess to where the working set's equations hold; entries that reach the end of their range
   on the way leave or change part. The dual objective rises all the way. */
static int qpc_settle(qpc_solver* s) {
  double rate[QPC_ACTIVE_PADDED];
  while (s->iterations < QPC_MAX_CHANGES) {
    int blocking;
    for (int i = 0; i < s->active_count; ++i) {
      double sum = s->target[i];
      for (int c = 0; c < QPC_COMPONENTS; ++c) sum -= s->normal[c][i] * s->free_output[s->point[c][i]];
      s->column[i] = sum;
    }
    for (int i = s->active_count; i < QPC_ROUND_UP(s->active_count, QPC_WIDTH); ++i) s->column[i] = 0.0;
    qpc_multiply_inverse(s, s->column, s->direction);
    for (int i = 0; i < s->active_count; i += QPC_WIDTH) {
      QPC_STORE(&rate[i], QPC_LOAD(&s->lambda[i]) - QPC_LOAD(&s->direction[i]));
    }
    const double step = qpc_longest_step(s, rate, &blocking);
    if (step >= 1.0) {
      qpc_step(s, rate, 1.0);
      return 1;
    }
    ++s->iterations;
    qpc_step(s, rate, step);
    if (!qpc_pass_edge(s, blocking, rate[blocking] < 0.0)) qpc_remove(s, blocking);
  }
  return 0;
}

/* A step of iterative refinement: `column` holds the residual at the present outputs. */
static void qpc_correct(qpc_solver* s) {
  qpc_multiply_inverse(s, s->column, s->direction);
  for (int i = 0; i < s->active_count; ++i) {
    const double lambda = s->lambda[i] + s->direction[i];
    s->lambda[i] = lambda < s->least[i] ? s->least[i] : lambda > s->most[i] ? s->most[i] : lambda;
  }
}

static int qpc_is_row(const qpc_solver* s, int id) {
  if (id < 0 || id >= QPC_FIRST_QUADRATIC_ID) return 0;
  if (id >= QPC_FIRST_BOUND_ID) {
    const int place = (id - QPC_FIRST_BOUND_ID) / 2;
    const double bound = (id - QPC_FIRST_BOUND_ID) % 2 != 0 ? s->upper[place] : -s->lower[place];
    return bound < QPC_UNBOUNDED;
  }
  return s->row_offset[id] > -QPC_UNBOUNDED;
}

/* The working set to start from: the quadratic terms, and those of the guessed rows that do not depend on each other.
   Masked rows are not accepted, which leaves out what was guessed twice. */
static int qpc_start(const qpc_tables* t, qpc_solver* s) {
  qpc_row row;
  s->active_count = 0;
  const int guesses = s->warm_count < 0 ? 0 : s->warm_count > QPC_MAX_ACTIVE ? QPC_MAX_ACTIVE : s->warm_count;
  for (int i = 0; i < s->quadratic_count + guesses && s->active_count < QPC_MAX_ACTIVE; ++i) {
    const int is_guess = i >= s->quadratic_count;
    const int id = is_guess ? s->warm_id[i - s->quadratic_count] : QPC_FIRST_QUADRATIC_ID + i;
    double lambda = is_guess ? s->warm_multiplier[i - s->quadratic_count] : 0.0;
    if (is_guess && (!(lambda > 0.0) || !qpc_is_finite(lambda) || !qpc_is_row(s, id))) continue;
    lambda /= qpc_scale_of(s, id);
    if (!qpc_load_row(t, s, id, &row)) return QPC_BAD_DATA;
    const double self = qpc_gram_self(t, &row);
    const int soft = lambda > row.linear || row.linear <= 0.0;
    qpc_gram_column(t, s, &row);
    double curvature = qpc_project(s, self);
    if (curvature < 0.0) curvature = 0.0;
    if (soft) curvature += row.compliance;
    if (curvature > 1e-8 * self) qpc_append(s, &row, lambda, soft, curvature);
  }
  return s->active_count == 0 || qpc_settle(s) ? QPC_SOLVED : QPC_CAP;
}

/* The most violated row, or -1 with all outputs up to date. */
static int qpc_find_violated(const qpc_tables* t, qpc_solver* s, double tolerance, double* violation) {
  if (s->listed_count > 0 || s->listed_bounds) {
    qpc_update_outputs(t, s, 0);
    const int id = qpc_scan_listed(s, tolerance, violation);
    if (id >= 0) return id;
  }
  qpc_update_outputs(t, s, 1);
  return qpc_scan(s, tolerance, violation);
}

static int qpc_active_set(const qpc_tables* t, qpc_solver* s, double tolerance) {
  double violation;
  int refinements = 0;
  s->listed_count = s->listed_bounds = 0;
  int status = qpc_start(t, s);
  while (status == QPC_SOLVED) {
    const int id = qpc_find_violated(t, s, tolerance, &violation);
    if (id >= 0) {
      qpc_row row;
      if (!qpc_load_row(t, s, id, &row)) return QPC_BAD_DATA;
      status = qpc_enter(t, s, &row, violation);
    } else {
      /* The last correction below gains more digits than this asks for. */
      const int exact = qpc_residual(s) <= tolerance;
      qpc_correct(s);
      if (exact) break;
      if (++refinements > 8) status = QPC_CAP;
    }
  }
  return status;
}
