/* ---- Dual active set (Goldfarb and Idnani) on the tables. ----
   The working set's rows hold n . y + flexibility * multiplier = target. Its multipliers are known exactly through the
   inverse of its Gram matrix, kept up to date by rank-one changes. A soft row is rigid up to the multiplier
   `row_linear` and has flexibility 1 / quadratic above: a change of part is a rank-one change as well. */

/* A rank-one change that takes back entries of this size, relative to what they become, loses as many digits: then
   inverse_gram is made anew. */
#define QPC_LOST_DIGITS 1e5

/* result = m v, m symmetric and of the working set's size. */
QPC_FUNCTION void qpc_multiply(const double (*m)[QPC_ACTIVE_PADDED], int n, const double* v, double* result) {
  for (int j = 0; j < n; j += QPC_WIDTH) {
    qpc_vector sum = QPC_BROADCAST(0.0), other = sum;
    int i = 0;
    for (; i + 1 < n; i += 2) {
      sum += QPC_LOAD(&m[i][j]) * v[i];
      other += QPC_LOAD(&m[i + 1][j]) * v[i + 1];
    }
    if (i < n) sum += QPC_LOAD(&m[i][j]) * v[i];
    QPC_STORE(&result[j], sum + other);
  }
}

/* result = inverse_gram v */
static void qpc_multiply_inverse(const qpc_solver* s, const double* v, double* result) {
  qpc_multiply((const double(*)[QPC_ACTIVE_PADDED])s->inverse_gram, s->active_count, v, result);
}

/* result = v - (gram + flexibility) x, and 0 in the places that fill up the last vector. */
static void qpc_gram_residual(const qpc_solver* s, const double* v, const double* x, double* result) {
  const int n = s->active_count;
  qpc_multiply((const double(*)[QPC_ACTIVE_PADDED])s->gram, n, x, result);
  for (int i = 0; i < n; ++i) result[i] = v[i] - s->flexibility[i] * x[i] - result[i];
  for (int i = n; i < QPC_ROUND_UP(n, QPC_WIDTH); ++i) result[i] = 0.0;
}

static double qpc_dot(const double* a, const double* b, int count) {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

/* inverse_gram += factor v v' */
static void qpc_rank_one(qpc_solver* s, const double* v, double factor) {
  const int n = s->active_count;
  for (int i = 0; i < n; ++i) {
    const double f = factor * v[i];
    for (int j = 0; j < n; j += QPC_WIDTH) {
      QPC_STORE(&s->inverse_gram[i][j], QPC_LOAD(&s->inverse_gram[i][j]) + QPC_LOAD(&v[j]) * f);
    }
  }
}

/* Sets which part of its penalty entry i is in: the range of its multiplier, and what its equation says. */
static void qpc_set_part(qpc_solver* s, int i, int soft) {
  s->flexibility[i] = soft ? s->row_compliance[i] : 0.0;
  s->least[i] = soft ? s->row_linear[i] : 0.0;
  s->most[i] = soft ? QPC_UNBOUNDED : s->row_linear[i];
  s->target[i] = s->offset[i] + (soft ? s->row_linear[i] * s->row_compliance[i] : 0.0);
  if (QPC_IS_TERM(s->active_id[i])) s->least[i] = -QPC_UNBOUNDED;
}

/* Borders inverse_gram by one more entry: `direction` = inverse_gram * its column, `curvature` its Schur complement. */
static void qpc_border(qpc_solver* s, double curvature) {
  const int n = s->active_count;
  qpc_rank_one(s, s->direction, 1.0 / curvature);
  const int end = QPC_ROUND_UP(n + 1, 8);
  for (int j = 0; j < end; ++j) s->inverse_gram[n][j] = j < n ? -s->direction[j] / curvature : 0.0;
  s->inverse_gram[n][n] = 1.0 / curvature;
  if (n % 8 == 0) {
    for (int i = 0; i < n; ++i) {
      for (int j = n; j < n + 8; ++j) s->inverse_gram[i][j] = 0.0;
    }
  }
  for (int i = 0; i < n; ++i) s->inverse_gram[i][n] = s->inverse_gram[n][i];
  s->active_count = n + 1;
}

/* inverse_gram anew from gram; 0 if an entry depends on those before it. */
static int qpc_rebuild(qpc_solver* s) {
  const int count = s->active_count;
  s->delicate = 1;
  s->active_count = 0;
  for (int n = 0; n < count; ++n) {
    qpc_multiply_inverse(s, s->gram[n], s->direction);
    const double curvature = s->gram[n][n] + s->flexibility[n] - qpc_dot(s->gram[n], s->direction, n);
    if (!(curvature > 1e-14 * s->gram[n][n])) {
      s->active_count = count;
      return 0;
    }
    qpc_border(s, curvature);
  }
  return 1;
}

/* Appends the row; `column`, `direction` = inverse_gram * column and `curvature`, its Schur complement, belong to it. */
static void qpc_append(qpc_solver* s, const qpc_row* row, double lambda, int soft, double self, double curvature) {
  const int n = s->active_count;
  for (int j = 0; j < n; ++j) s->gram[n][j] = s->gram[j][n] = s->column[j];
  s->gram[n][n] = self;
  qpc_border(s, curvature);
  for (int c = 0; c < QPC_ROW_COMPONENTS; ++c) {
    s->point[c][n] = row->place[c];
    s->normal[c][n] = row->normal[c];
  }
  s->active_id[n] = row->id;
  s->offset[n] = row->offset;
  s->row_linear[n] = row->linear;
  s->row_compliance[n] = row->compliance;
  s->lambda[n] = lambda;
  qpc_set_part(s, n, soft);
  qpc_mask_row(s, row->id, 1, 0.0);
}

static void qpc_copy_entry(qpc_solver* s, int to, int from) {
  for (int c = 0; c < QPC_ROW_COMPONENTS; ++c) {
    s->point[c][to] = s->point[c][from];
    s->normal[c][to] = s->normal[c][from];
  }
  s->active_id[to] = s->active_id[from];
  s->offset[to] = s->offset[from];
  s->target[to] = s->target[from];
  s->flexibility[to] = s->flexibility[from];
  s->row_compliance[to] = s->row_compliance[from];
  s->row_linear[to] = s->row_linear[from];
  s->least[to] = s->least[from];
  s->most[to] = s->most[from];
  s->lambda[to] = s->lambda[from];
  s->column[to] = s->column[from];
}

/* Row and column `last` of m take the place of row and column i. */
QPC_FUNCTION void qpc_move_last(double (*m)[QPC_ACTIVE_PADDED], int i, int last) {
  for (int j = 0; j <= last; ++j) m[i][j] = m[last][j];
  for (int j = 0; j <= last; ++j) m[j][i] = m[j][last];
  m[i][i] = m[last][last];
}

/* Takes entry i out of the working set; the last entry takes its place. */
static void qpc_remove(qpc_solver* s, int i) {
  const int last = s->active_count - 1;
  double v[QPC_ACTIVE_PADDED];
  for (int j = 0; j < QPC_ROUND_UP(last + 1, 8); ++j) v[j] = s->inverse_gram[i][j];
  const double lost = s->inverse_gram[i][i] * (s->gram[i][i] + s->flexibility[i]);
  qpc_rank_one(s, v, -1.0 / v[i]);
  qpc_mask_row(s, s->active_id[i], 0, s->offset[i]);
  if (i != last) {
    qpc_move_last(s->inverse_gram, i, last);
    qpc_move_last(s->gram, i, last);
    qpc_copy_entry(s, i, last);
  }
  for (int j = 0; j <= last; ++j) s->inverse_gram[j][last] = 0.0;
  s->column[last] = 0.0;
  s->active_count = last;
  if (!(lost > 0.0 && lost < QPC_LOST_DIGITS)) qpc_rebuild(s);
}

/* Moves entry i to the other part of its penalty. 0 if the rigid part would make the working set dependent, or nearly:
   then the digits of the present inverse do not suffice. */
static int qpc_change_part(qpc_solver* s, int i) {
  const int soft = s->flexibility[i] == 0.0;
  const double change = soft ? s->row_compliance[i] : -s->row_compliance[i];
  double v[QPC_ACTIVE_PADDED];
  const double pivot = 1.0 + change * s->inverse_gram[i][i];
  if (!soft && !(pivot > 1e-4)) return 0;
  for (int j = 0; j < QPC_ROUND_UP(s->active_count, 8); ++j) v[j] = s->inverse_gram[i][j];
  qpc_rank_one(s, v, -change / pivot);
  qpc_set_part(s, i, soft);
  if (soft && !(pivot > 0.0 && pivot < QPC_LOST_DIGITS)) qpc_rebuild(s);
  return 1;
}

/* The longest step t >= 0 of lambda - t * rate that keeps every multiplier in its range, and the entry that stops it
   (-1: none). */
static double qpc_longest_step(const qpc_solver* s, const double* rate, int* blocking) {
  double step = QPC_UNBOUNDED;
  *blocking = -1;
  for (int i = 0; i < s->active_count; ++i) {
    const double edge = rate[i] > 0.0 ? s->least[i] : s->most[i];
    const double room = s->lambda[i] - edge;
    if (rate[i] == 0.0 || edge <= -QPC_UNBOUNDED || edge >= QPC_UNBOUNDED) continue;
    if (room / rate[i] < step) {
      step = room / rate[i];
      *blocking = i;
    }
  }
  return step > 0.0 ? step : 0.0;
}
