/* ---- Constants of the method; products with the sparse matrices, and their scaling. ---- */

#define QPC_REGULARISATION 1e-4   /* of K's diagonal, relative to the average complementarity */
#define QPC_LEAST_REGULARISATION 1e-8 /* less, down to QPC_NO_REGULARISATION, where it is in the way */
#define QPC_NO_REGULARISATION 1e-11
#define QPC_MOST_REGULARISATION 1e-5
#define QPC_FIXED_WEIGHT 1e8
#define QPC_SMALLEST_PIVOT 1e-12  /* of the right sign; smaller ones are as good as 0 */
#define QPC_WRONG_PIVOT 1e-6      /* of the wrong sign; greater ones are no rounding of numbers up to 1 */
#define QPC_MOST_PRODUCT 10.0     /* second-order terms of the corrector, relative to the average complementarity */
#define QPC_STEP_SHARE 0.995      /* of the step at which something would become 0 */
#define QPC_SHORT_STEP 0.1        /* a step so short is not worth while */
#define QPC_NEARLY_FEASIBLE 1e-4
#define QPC_LEAST_CENTRE 1e-3     /* complementarities do not vanish faster than residuals by more than this */
#define QPC_LEAST_WEIGHT 1e-20    /* keeps 1 / weight finite for rows without bounds */
#define QPC_REFINEMENTS 1         /* of every solution of Newton's equations */
#define QPC_START_PUSH 8.0        /* multipliers of a cold start, in units of the average push of the penalties */
#define QPC_WARM_CENTRE 1e-6      /* complementarities of a warm start, and the least multiplier and room */
#define QPC_WARM_ROOM 1e-3
#define QPC_CERTAINTY 1e8         /* a proof that no point of less than this size, relative, meets the rows is enough */
#define QPC_LEAST_COST 1e-2       /* the gap is relative to the cost, but not to less than this, scaled */
#define QPC_UNBOUNDED_LEAST 1e299 /* bounds from here on are none */

static double qpc_larger(double a, double b) { return a > b ? a : b; }

/* A power of two, about 1 / sqrt(value); of 0: 1. */
static double qpc_inverse_root(double value) {
  union {
    double number;
    uint64_t bits;
  } view;
  if (!(value > 0.0)) return 1.0;
  view.number = value;
  const int exponent = (int)((view.bits >> 52) & 0x7ffu) - 1023;
  view.bits = (uint64_t)(1023 - exponent / 2) << 52;
  return view.number;
}

/* H x */
static void qpc_multiply_hessian(const qpc_matrices* m, const double* x, double* result) {
  qpc_clear(result, QPC_VARIABLES);
  for (int i = 0; i < QPC_VARIABLES && QPC_HESSIAN_ENTRIES > 0; ++i) {
    double sum = 0.0;
    for (int k = qpc_hessian_start[i]; k < qpc_hessian_start[i + 1]; ++k) {
      const int j = qpc_hessian_column[k];
      sum += m->hessian[k] * x[j];
      if (j != i) result[j] += m->hessian[k] * x[i];
    }
    result[i] += sum;
  }
}

/* [A x; x] */
static void qpc_evaluate_places(const qpc_matrices* m, const double* x, double* value) {
  for (int r = 0; r < QPC_ROWS; ++r) {
    double sum = 0.0;
    for (int k = qpc_matrix_start[r]; k < qpc_matrix_start[r + 1]; ++k) sum += m->matrix[k] * x[qpc_matrix_column[k]];
    value[r] = sum;
  }
  for (int j = 0; j < QPC_VARIABLES; ++j) value[QPC_ROWS + j] = x[j];
}

/* result -= A' y + z for the pull [y; z] */
static void qpc_subtract_pull(const qpc_matrices* m, const double* pull, double* result) {
  for (int j = 0; j < QPC_VARIABLES; ++j) result[j] -= pull[QPC_ROWS + j];
  for (int r = 0; r < QPC_ROWS; ++r) {
    const double y = pull[r];
    for (int k = qpc_matrix_start[r]; k < qpc_matrix_start[r + 1]; ++k) {
      result[qpc_matrix_column[k]] -= m->matrix[k] * y;
    }
  }
}

/* The largest entry of every column of [H A'; A 0]. */
static void qpc_column_sizes(const qpc_matrices* m, double* variable, double* row) {
  qpc_clear(variable, QPC_VARIABLES);
  for (int i = 0; i < QPC_VARIABLES && QPC_HESSIAN_ENTRIES > 0; ++i) {
    for (int k = qpc_hessian_start[i]; k < qpc_hessian_start[i + 1]; ++k) {
      const double size = qpc_magnitude(m->hessian[k]);
      variable[i] = qpc_larger(variable[i], size);
      variable[qpc_hessian_column[k]] = qpc_larger(variable[qpc_hessian_column[k]], size);
    }
  }
  for (int r = 0; r < QPC_ROWS; ++r) {
    row[r] = 0.0;
    for (int k = qpc_matrix_start[r]; k < qpc_matrix_start[r + 1]; ++k) {
      const double size = qpc_magnitude(m->matrix[k]);
      row[r] = qpc_larger(row[r], size);
      variable[qpc_matrix_column[k]] = qpc_larger(variable[qpc_matrix_column[k]], size);
    }
  }
}

/* Ruiz's equilibration: every column is divided by the square root of its largest entry until all are about 1. */
static void qpc_equilibrate(qpc_matrices* m) {
  double variable[QPC_VARIABLES], row[QPC_AT_LEAST_ONE(QPC_ROWS)];
  for (int j = 0; j < QPC_VARIABLES; ++j) m->variable_scale[j] = 1.0;
  for (int r = 0; r < QPC_ROWS; ++r) m->row_scale[r] = 1.0;
  for (int sweep = 0; sweep < 10; ++sweep) {
    int changed = 0;
    qpc_column_sizes(m, variable, row);
    for (int j = 0; j < QPC_VARIABLES; ++j) {
      variable[j] = qpc_inverse_root(variable[j]);
      m->variable_scale[j] *= variable[j];
      changed |= variable[j] != 1.0;
    }
    for (int r = 0; r < QPC_ROWS; ++r) {
      row[r] = qpc_inverse_root(row[r]);
      m->row_scale[r] *= row[r];
      changed |= row[r] != 1.0;
    }
    if (!changed) return;
    for (int i = 0; i < QPC_VARIABLES && QPC_HESSIAN_ENTRIES > 0; ++i) {
      for (int k = qpc_hessian_start[i]; k < qpc_hessian_start[i + 1]; ++k) {
        m->hessian[k] *= variable[i] * variable[qpc_hessian_column[k]];
      }
    }
    for (int r = 0; r < QPC_ROWS; ++r) {
      for (int k = qpc_matrix_start[r]; k < qpc_matrix_start[r + 1]; ++k) {
        m->matrix[k] *= row[r] * variable[qpc_matrix_column[k]];
      }
    }
  }
}

/* A diagonal without negative numbers, which every positive semidefinite matrix has. */
static int qpc_may_be_convex(const double* hessian) {
  for (int j = 0; j < QPC_VARIABLES && QPC_HESSIAN_ENTRIES > 0; ++j) {
    const int last = qpc_hessian_start[j + 1] - 1;
    if (last >= qpc_hessian_start[j] && qpc_hessian_column[last] == j && hessian[last] < 0.0) return 0;
  }
  return 1;
}
