/* ---- The solver's functions. ---- */

int qpc_function(setup)(qpc_tables* t, const qpc_parameters* p, uint64_t hash) {
  if (hash != QPC_HASH) return QPC_WRONG_VERSION;
  qpc_clear((double*)t, (int)(sizeof *t / sizeof(double)));
  qpc_evaluate(t, p);
  const double* numbers = (const double*)t;
  for (int i = 0; i < (int)(sizeof *t / sizeof(double)); ++i) {
    if (!qpc_is_finite(numbers[i])) return QPC_BAD_DATA;
  }
  for (int i = 1; i <= QPC_PENALTIES; ++i) {
    if (!(t->penalty_linear[i] >= 0.0) || !(t->penalty_quadratic[i] > 0.0)) return QPC_BAD_DATA;
  }
  if (!qpc_may_be_convex(t->hessian)) return QPC_NOT_CONVEX;
  for (int k = 0; k < QPC_HESSIAN_ENTRIES; ++k) t->scaled.hessian[k] = t->hessian[k];
  for (int k = 0; k < QPC_MATRIX_ENTRIES; ++k) t->scaled.matrix[k] = t->matrix[k];
  qpc_equilibrate(&t->scaled);
  return QPC_SOLVED;
}

void qpc_function(init)(qpc_solver* s, const qpc_tables* t) {
  uint8_t* bytes = (uint8_t*)s;
  for (size_t i = 0; i < sizeof *s; ++i) bytes[i] = 0;
  s->tolerance = 1e-9;
  for (int j = 0; j < QPC_VARIABLES; ++j) {
    s->linear[j] = t->linear[j];
    s->lower[j] = t->lower[j];
    s->upper[j] = t->upper[j];
  }
  for (int r = 0; r < QPC_ROWS; ++r) {
    s->row_lower[r] = t->row_lower[r];
    s->row_upper[r] = t->row_upper[r];
    s->row_penalty[r] = qpc_row_penalty[r];
  }
}

int qpc_function(hessian_index)(int row, int column) {
  const int i = row > column ? row : column, j = row > column ? column : row;
  if (j < 0 || i >= QPC_VARIABLES) return -1;
  for (int k = qpc_hessian_start[i]; k < qpc_hessian_start[i + 1]; ++k) {
    if (qpc_hessian_column[k] == j) return qpc_hessian_varying[k];
  }
  return -1;
}

int qpc_function(matrix_index)(int row, int column) {
  if (row < 0 || row >= QPC_ROWS) return -1;
  for (int k = qpc_matrix_start[row]; k < qpc_matrix_start[row + 1]; ++k) {
    if (qpc_matrix_column[k] == column) return qpc_matrix_varying[k];
  }
  return -1;
}

/* H and A of this solve in s->own; 0 if H cannot be convex. */
static int qpc_fill_matrices(const qpc_tables* t, qpc_solver* s) {
  for (int k = 0; k < QPC_HESSIAN_ENTRIES; ++k) {
    s->own.hessian[k] = qpc_hessian_varying[k] < 0 ? t->hessian[k] : s->hessian[qpc_hessian_varying[k]];
  }
  for (int k = 0; k < QPC_MATRIX_ENTRIES; ++k) {
    s->own.matrix[k] = qpc_matrix_varying[k] < 0 ? t->matrix[k] : s->matrix[qpc_matrix_varying[k]];
  }
  if (!qpc_may_be_convex(s->own.hessian)) return 0;
  qpc_equilibrate(&s->own);
  return 1;
}

/* Numbers are finite, bounds are no NaN and not infinite on the wrong side, penalties exist. */
static int qpc_data_valid(const qpc_solver* s) {
  if (!qpc_all_finite(s->linear, QPC_VARIABLES) || !(s->tolerance > 0.0)) return 0;
  if (!qpc_all_finite(s->hessian, QPC_HESSIAN_VARYING) || !qpc_all_finite(s->matrix, QPC_MATRIX_VARYING)) return 0;
  for (int r = 0; r < QPC_ROWS; ++r) {
    if (s->row_penalty[r] > QPC_PENALTIES) return 0;
    if (r < QPC_EQUALITIES && (s->row_penalty[r] != QPC_HARD || !qpc_is_finite(s->row_lower[r]))) return 0;
    if (qpc_has_lower[r] && !(s->row_lower[r] < QPC_UNBOUNDED_LEAST)) return 0;
    if (qpc_has_upper[r] && !(s->row_upper[r] > -QPC_UNBOUNDED_LEAST)) return 0;
  }
  for (int j = 0; j < QPC_VARIABLES; ++j) {
    if (qpc_has_lower[QPC_ROWS + j] && !(s->lower[j] < QPC_UNBOUNDED_LEAST)) return 0;
    if (qpc_has_upper[QPC_ROWS + j] && !(s->upper[j] > -QPC_UNBOUNDED_LEAST)) return 0;
  }
  if (!s->warm) return 1;
  return qpc_all_finite(s->warm_x, QPC_VARIABLES) && qpc_all_finite(s->warm_row_multiplier, QPC_ROWS) &&
         qpc_all_finite(s->warm_bound_multiplier, QPC_VARIABLES);
}

static void qpc_add_side(const qpc_tables* t, qpc_solver* s, int place, double sign, double bound, double scale) {
  const int e = s->side_count++, penalty = place < QPC_ROWS ? s->row_penalty[place] : QPC_HARD;
  s->side_place[e] = place;
  s->side_sign[e] = sign;
  s->side_offset[e] = sign * bound;
  s->side_soft[e] = penalty != QPC_HARD && t->penalty_linear[penalty] > 0.0 ? 1.0 : 0.0;
  s->side_linear[e] = penalty == QPC_HARD ? 0.0 : s->cost_scale * t->penalty_linear[penalty] / scale;
  s->side_quadratic[e] = penalty == QPC_HARD ? 0.0 : s->cost_scale * t->penalty_quadratic[penalty] / (scale * scale);
}

/* Lists the sides that exist in this solve; 0 if a lower bound exceeds the upper one. */
static int qpc_list_sides(const qpc_tables* t, const qpc_matrices* m, qpc_solver* s) {
  s->side_count = 0;
  for (int p = 0; p < QPC_PLACES; ++p) {
    const int j = p - QPC_ROWS;
    const double scale = j < 0 ? m->row_scale[p] : 1.0 / m->variable_scale[j];
    const double lower = j < 0 ? s->row_lower[p] : s->lower[j], upper = j < 0 ? s->row_upper[p] : s->upper[j];
    const int below = qpc_has_lower[p] && lower > -QPC_UNBOUNDED_LEAST;
    const int above = qpc_has_upper[p] && upper < QPC_UNBOUNDED_LEAST;
    const int hard = j >= 0 || s->row_penalty[p] == QPC_HARD;
    const double size = 1.0 + qpc_magnitude(lower * scale);
    s->target[p] = lower * scale;
    s->fixed[p] = p < QPC_EQUALITIES;
    if (below && above && hard) {
      if ((lower - upper) * scale > 1e-9 * size) return 0;
      s->fixed[p] = (upper - lower) * scale <= 1e-10 * size;
      if (s->fixed[p]) s->target[p] = 0.5 * (lower + upper) * scale;
    }
    if (s->fixed[p]) continue;
    if (below) qpc_add_side(t, s, p, 1.0, lower * scale, scale);
    if (above) qpc_add_side(t, s, p, -1.0, upper * scale, scale);
  }
  return 1;
}

/* The gradient in scaled variables, and the cost's own scale. */
static void qpc_scale_cost(const qpc_matrices* m, qpc_solver* s) {
  double size = 0.0;
  for (int j = 0; j < QPC_VARIABLES; ++j) {
    s->gradient[j] = s->linear[j] * m->variable_scale[j];
    size = qpc_larger(size, qpc_magnitude(s->gradient[j]));
  }
  for (int k = 0; k < QPC_HESSIAN_ENTRIES; ++k) size = qpc_larger(size, qpc_magnitude(m->hessian[k]));
  s->cost_scale = qpc_inverse_root(size);
  s->cost_scale *= s->cost_scale;
  for (int j = 0; j < QPC_VARIABLES; ++j) s->gradient[j] *= s->cost_scale;
}

/* The result in the caller's units; 0 if a number is not finite. */
static int qpc_recover(const qpc_matrices* m, qpc_solver* s) {
  qpc_collect_pulls(s);
  for (int j = 0; j < QPC_VARIABLES; ++j) {
    s->x[j] = s->position[j] * m->variable_scale[j];
    s->bound_multiplier[j] = s->pull[QPC_ROWS + j] / (m->variable_scale[j] * s->cost_scale);
  }
  for (int r = 0; r < QPC_ROWS; ++r) s->row_multiplier[r] = s->pull[r] * m->row_scale[r] / s->cost_scale;
  return qpc_all_finite(s->x, QPC_VARIABLES) && qpc_all_finite(s->bound_multiplier, QPC_VARIABLES) &&
         qpc_all_finite(s->row_multiplier, QPC_ROWS) && qpc_is_finite(s->objective);
}

static int qpc_check_and_run(const qpc_tables* t, qpc_solver* s) {
  const int varying = QPC_HESSIAN_VARYING + QPC_MATRIX_VARYING > 0;
  const qpc_matrices* m = varying ? &s->own : &t->scaled;
  if (!qpc_data_valid(s)) return QPC_BAD_DATA;
  if (varying && !qpc_fill_matrices(t, s)) return QPC_NOT_CONVEX;
  qpc_scale_cost(m, s);
  if (!qpc_list_sides(t, m, s)) return QPC_INFEASIBLE;
  qpc_assemble_constant(m, s);
  int status = QPC_CAP;
  if (s->warm) {
    qpc_start_warm(m, s);
    status = qpc_iterate(m, s);
  }
  if (status != QPC_SOLVED) status = qpc_start_cold(m, s) ? qpc_iterate(m, s) : QPC_NOT_CONVEX;
  if (status != QPC_SOLVED) return status;
  return qpc_recover(m, s) ? QPC_SOLVED : QPC_BAD_DATA;
}

int qpc_function(solve)(const qpc_tables* t, qpc_solver* s) {
  s->iterations = 0;
  s->residual = 0.0;
  s->status = qpc_check_and_run(t, s);
  if (s->status != QPC_SOLVED) {
    qpc_clear(s->x, QPC_VARIABLES);
    qpc_clear(s->row_multiplier, QPC_ROWS);
    qpc_clear(s->bound_multiplier, QPC_VARIABLES);
    s->objective = s->residual = 0.0;
  }
  return s->status;
}

#if defined(__clang__)
#pragma clang attribute pop
#endif
