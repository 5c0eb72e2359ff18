/* ---- The active-set iterations. ---- */

/* A Schur complement below this, relative to the terms that cancel in it, counts as linear dependence. */
#define QPC_DEPENDENT 1e-14

/* What rounding leaves in outputs, relative to the terms that they are sums of; squared. */
#define QPC_ROUNDING 1e-29

/* Sum of the working set's forces, each in the metric of the Hessian; squared. With the square of a row's own Gram entry
   that bounds the terms of its output. */
static double qpc_forces(const qpc_solver* s) {
  double sum = 0.0;
  for (int i = 0; i < s->active_count; ++i) sum += s->lambda[i] * s->lambda[i] * s->gram[i][i];
  return s->active_count * sum;
}

/* Refines `direction` until its residual is one of rounding, and returns the curvature, in a form whose error is the
   square of the direction's. The inverse is made anew if refinement does not converge with it. */
static double qpc_project_carefully(qpc_solver* s, double self) {
  double residual[QPC_ACTIVE_PADDED], step[QPC_ACTIVE_PADDED];
  const int n = s->active_count;
  double last = QPC_UNBOUNDED, curvature = self;
  s->delicate = 1;
  for (int tries = 0, rebuilt = 0; tries < 8; ++tries) {
    qpc_gram_residual(s, s->column, s->direction, residual);
    curvature = self - qpc_dot(s->column, s->direction, n) - qpc_dot(residual, s->direction, n);
    qpc_multiply_inverse(s, residual, step);
    const double energy = qpc_dot(residual, step, n);
    if (energy >= 0.0 && energy <= 1e-30 * self) break;
    if (!(energy >= 0.0 && energy < 1e-2 * last && energy < 1e-6 * self)) {
      if ((energy >= 0.0 && energy < 1e-20 * self) || rebuilt++ || !qpc_rebuild(s)) break;
      last = QPC_UNBOUNDED;
      qpc_multiply_inverse(s, s->column, s->direction);
      continue;
    }
    for (int i = 0; i < n; ++i) s->direction[i] += step[i];
    last = energy;
  }
  double terms = self;
  for (int i = 0; i < n; ++i) terms += qpc_magnitude(s->column[i] * s->direction[i]);
  return curvature > QPC_DEPENDENT * terms ? curvature : 0.0;
}

/* direction = inverse_gram column; returns the row's curvature left over by the working set, 0 if it depends on it. */
static double qpc_project(qpc_solver* s, double self) {
  qpc_multiply_inverse(s, s->column, s->direction);
  const double curvature = self - qpc_dot(s->column, s->direction, s->active_count);
  return curvature > 1e-4 * self ? curvature : qpc_project_carefully(s, self);
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

/* Makes entry i rigid by taking it out and in again, which costs no digits. Stays out if it depends on the others: the
   scan will find it, should that be wrong. */
static void qpc_stiffen(qpc_model t, qpc_solver* s, int i) {
  qpc_row row;
  const double lambda = s->lambda[i];
  const int id = s->active_id[i];
  qpc_remove(s, i);
  if (!qpc_load_row(t, s, id, &row)) return;
  const double self = qpc_gram_self(t, &row);
  qpc_gram_column(t, s, &row);
  const double curvature = qpc_project(s, self);
  if (curvature > 0.0) qpc_append(s, &row, lambda, 0, self, curvature);
}

/* Entry i should become rigid, at the multiplier where its penalty bends, but depends on the other entries. Its
   multiplier is handed over to them, which changes neither outputs nor dual objective, until it is 0 or another entry
   leaves or becomes flexible. 0 if that does not come to an end. */
static int qpc_hand_over(qpc_model t, qpc_solver* s, int i) {
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
    if (curvature > 0.0) {
      qpc_append(s, &row, lambda, 0, self, curvature);
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
    if (!qpc_pass_edge(s, blocking, rate[blocking] < 0.0)) qpc_stiffen(t, s, blocking);
  }
  return 0;
}

/* Adds a violated row: its multiplier grows from 0 until the row holds, past every change of the working set on the
   way. */
static int qpc_enter(qpc_model t, qpc_solver* s, const qpc_row* row, double violation) {
  const double self = qpc_gram_self(t, row);
  double lambda = 0.0;
  int soft = row->linear <= 0.0;
  qpc_gram_column(t, s, row);
  while (s->iterations < QPC_MAX_CHANGES) {
    int blocking;
    double curvature = qpc_project(s, self);
    if (soft) curvature += row->compliance;
    const double full = curvature > 0.0 ? violation / curvature : QPC_UNBOUNDED;
    const double bend = soft ? QPC_UNBOUNDED : row->linear - lambda;
    const double longest = qpc_longest_step(s, s->direction, &blocking);
    ++s->iterations;
    if (full <= longest && full <= bend && full < QPC_UNBOUNDED) {
      if (s->active_count == QPC_MAX_ACTIVE) return QPC_CAP;
      qpc_step(s, s->direction, full);
      qpc_append(s, row, lambda + full, soft, self, curvature);
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
  const double forces = qpc_forces(s);
  double largest = 0.0;
  for (int i = 0; i < s->active_count; ++i) {
    double r = s->target[i] - s->flexibility[i] * s->lambda[i];
    for (int c = 0; c < QPC_ROW_COMPONENTS; ++c) r -= s->normal[c][i] * s->output[s->point[c][i]];
    s->column[i] = r;
    const double size = qpc_magnitude(r) - 1e-14 * qpc_magnitude(s->target[i]);
    if (size > largest && r * r > QPC_ROUNDING * forces * s->gram[i][i]) largest = size;
  }
  for (int i = s->active_count; i < QPC_ROUND_UP(s->active_count, QPC_WIDTH); ++i) s->column[i] = 0.0;
  return largest;
}

/* Moves the multipliers of a guess to where the working set's equations hold; entries that reach the end of their range
   on the way leave or change part. The dual objective rises all the way. */
static int qpc_settle(qpc_model t, qpc_solver* s) {
  double rate[QPC_ACTIVE_PADDED];
  while (s->iterations < QPC_MAX_CHANGES) {
    int blocking;
    for (int i = 0; i < s->active_count; ++i) {
      double sum = s->target[i];
      for (int c = 0; c < QPC_ROW_COMPONENTS; ++c) sum -= s->normal[c][i] * s->free_output[s->point[c][i]];
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
    if (!qpc_pass_edge(s, blocking, rate[blocking] < 0.0) && !qpc_hand_over(t, s, blocking)) return 0;
  }
  return 0;
}

/* Adds a correction to the multipliers, each of which stays in its range. */
static void qpc_correct(qpc_solver* s, const double* correction) {
  for (int i = 0; i < s->active_count; ++i) {
    const double lambda = s->lambda[i] + correction[i];
    s->lambda[i] = lambda < s->least[i] ? s->least[i] : lambda > s->most[i] ? s->most[i] : lambda;
  }
}

/* Adds a correction as far as no multiplier leaves its range; the one that would then leaves the working set or changes
   part. 1 if all of it was added; -1 if the working set gets no further. */
static int qpc_correct_within(qpc_model t, qpc_solver* s, const double* correction) {
  double rate[QPC_ACTIVE_PADDED];
  int blocking;
  for (int i = 0; i < QPC_ROUND_UP(s->active_count, QPC_WIDTH); ++i) rate[i] = -correction[i];
  const double step = qpc_longest_step(s, rate, &blocking);
  qpc_step(s, rate, step < 1.0 ? step : 1.0);
  if (step >= 1.0) return 1;
  if (++s->iterations >= QPC_MAX_CHANGES) return -1;
  return qpc_pass_edge(s, blocking, rate[blocking] < 0.0) || qpc_hand_over(t, s, blocking) ? 0 : -1;
}

/* Adds a row or quadratic term to the working set, unless it nearly depends on it: then there is no telling its share of
   the multipliers. 0 if its penalty does not exist. */
static int qpc_guess(qpc_model t, qpc_solver* s, int id, double lambda) {
  qpc_row row;
  if (!qpc_load_row(t, s, id, &row)) return 0;
  const double self = qpc_gram_self(t, &row);
  const int soft = lambda > row.linear || row.linear <= 0.0;
  qpc_gram_column(t, s, &row);
  double curvature = qpc_project(s, self);
  if (!(curvature > 1e-4 * self)) curvature = 0.0;
  if (soft) curvature += row.compliance;
  if (curvature > 0.0) qpc_append(s, &row, lambda, soft, self, curvature);
  return 1;
}

/* The working set to start from: the quadratic terms, and the guessed rows. Masked rows are not accepted, which leaves
   out what was guessed twice. */
static int qpc_start_from(qpc_model t, qpc_solver* s, int guesses) {
  s->active_count = 0;
  for (int i = 0; i < s->quadratic_count && s->active_count < QPC_MAX_ACTIVE; ++i) {
    if (!qpc_guess(t, s, qpc_term_id(s, i), 0.0)) return QPC_BAD_DATA;
  }
  for (int i = 0; i < guesses && s->active_count < QPC_MAX_ACTIVE; ++i) {
    const int id = s->warm_id[i];
    const double lambda = s->warm_multiplier[i];
    if (!(lambda > 0.0) || !qpc_is_finite(lambda) || !qpc_is_row(s, id)) continue;
    if (!qpc_guess(t, s, id, lambda / qpc_scale_of(s, id))) return QPC_BAD_DATA;
  }
  return s->active_count == 0 || qpc_settle(t, s) ? QPC_SOLVED : QPC_CAP;
}

/* Starts from the guess, or without it if that leads nowhere. */
static int qpc_start(qpc_model t, qpc_solver* s) {
  const int guesses = s->warm_count < 0 ? 0 : s->warm_count > QPC_MAX_ACTIVE ? QPC_MAX_ACTIVE : s->warm_count;
  const int status = qpc_start_from(t, s, guesses);
  if (guesses == 0 || (status == QPC_SOLVED && qpc_all_finite(s->lambda, s->active_count))) return status;
  for (int i = 0; i < s->active_count; ++i) qpc_mask_row(s, s->active_id[i], 0, s->offset[i]);
  return qpc_start_from(t, s, 0);
}

/* Shows the scan the ignored rows again. */
static void qpc_notice(qpc_solver* s) {
  for (int i = 0; i < s->ignored_count; ++i) qpc_mask_row(s, s->ignored_id[i], 0, s->ignored_offset[i]);
  s->ignored_count = 0;
}

/* Whether a row that is hardly violated may stay so: its violation is one of rounding, or correcting it would move the
   inputs by less than the tolerance moves them where it is met exactly. That is not so of every small violation, since a
   row that nearly depends on the working set moves the inputs by violation / sqrt(curvature). `self` is the row's Gram
   entry; `least` the working set's smallest. */
static int qpc_is_faint(qpc_model t, qpc_solver* s, const qpc_row* row, double violation, double tolerance) {
  const double self = qpc_gram_self(t, row), square = violation * violation;
  if (square <= QPC_ROUNDING * qpc_forces(s) * self) return 1;
  if (violation > tolerance) return 0;
  if (s->ignored_count == QPC_ACTIVE_PADDED) return 1;
  qpc_gram_column(t, s, row);
  double curvature = qpc_project(s, self);
  if (curvature == 0.0) return 1;
  if (row->linear <= 0.0) curvature += row->compliance;
  return square * self <= tolerance * tolerance * curvature;
}

/* The working set holds and no row is violated: a step of refinement. 1: that was exact, or as exact as rounding lets it
   be, since the last one was no larger; 0: look again; -1: it does not converge. `last` is the size of the last step. */
static int qpc_finish(qpc_model t, qpc_solver* s, double tolerance, double* last) {
  double least = QPC_UNBOUNDED, correction[QPC_ACTIVE_PADDED];
  const double residual = qpc_residual(s);
  qpc_multiply_inverse(s, s->column, correction);
  const double energy = qpc_dot(s->column, correction, s->active_count);
  for (int i = 0; i < s->active_count; ++i) least = s->gram[i][i] < least ? s->gram[i][i] : least;
  const int converges = energy < 0.1 * *last;
  *last = energy;
  if (residual <= tolerance && (energy * least <= tolerance * tolerance || !converges)) {
    qpc_correct(s, correction);
    return 1;
  }
  const int added = qpc_correct_within(t, s, correction);
  if (added != 1) *last = QPC_UNBOUNDED;
  if (added < 0) return -1;
  return converges || added == 0 || qpc_rebuild(s) ? 0 : -1;
}

/* Whether the caller would rather have what there is than more changes. `begun`: those that the guess took, which are no
   more than it has rows. */
static int qpc_is_spent(const qpc_solver* s, int begun) {
  return s->most_changes > 0 && (s->iterations - begun >= s->most_changes || s->active_count == QPC_MAX_ACTIVE);
}

static int qpc_active_set(qpc_model t, qpc_solver* s, double tolerance) {
  double violation, last = QPC_UNBOUNDED;
  int refinements = 0;
  s->ignored_count = 0;
  s->listed_count = s->listed_bounds = s->delicate = 0;
  int status = qpc_start(t, s);
  const int begun = s->iterations;
  while (status == QPC_SOLVED) {
    const int id = qpc_find_violated(t, s, 1e-5 * tolerance, &violation);
    if (id < 0) {
      const int exact = qpc_finish(t, s, tolerance, &last);
      if (exact > 0) break;
      if (exact < 0 || (last < QPC_UNBOUNDED && ++refinements > 12)) status = QPC_CAP;
      continue;
    }
    qpc_row row;
    if (!qpc_load_row(t, s, id, &row)) {
      status = QPC_BAD_DATA;
    } else if (qpc_is_spent(s, begun)) {
      status = QPC_UNFINISHED;
    } else if (violation <= 1e3 * tolerance && qpc_is_faint(t, s, &row, violation, tolerance)) {
      if (s->ignored_count == QPC_ACTIVE_PADDED) break;
      s->ignored_id[s->ignored_count] = id;
      s->ignored_offset[s->ignored_count++] = row.offset;
      qpc_mask_row(s, id, 1, 0.0);
    } else {
      qpc_notice(s);
      last = QPC_UNBOUNDED;
      status = qpc_enter(t, s, &row, violation);
    }
  }
  qpc_notice(s);
  return status;
}
