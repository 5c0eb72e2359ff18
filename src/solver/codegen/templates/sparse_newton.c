/* ---- Newton's equations: K from the weights, and the steps that follow from the forces. ----
   With d pull = force - weight d value at every place, the optimality conditions become
       [H + bounds' weights, A'; A, -1 / weight] [dx; -dy] = [force of bounds - dual residual; force / weight].
   Rows that cost less so are eliminated: weight a a' goes to H, force a to the right side. Fixed places have the weight
   1 / regularisation; H and 1 / weight get the regularisation on their diagonals. K is then quasi-definite, has a
   factor in whatever order, and is not too far from singular. This only shortens steps and leaves a little of the rows'
   residuals; these are always those of the problem itself. */

/* A row's weight with the regularisation, as a share of that without. */
static double qpc_share(const qpc_solver* s, double weight) { return 1.0 / (1.0 + s->regularisation * weight); }

/* The part of K that no weight changes. */
static void qpc_assemble_constant(const qpc_matrices* m, qpc_solver* s) {
  qpc_clear(s->constant_kkt, QPC_KKT_ENTRIES);
  for (int k = 0; k < QPC_HESSIAN_ENTRIES; ++k) s->constant_kkt[qpc_hessian_slot[k]] += s->cost_scale * m->hessian[k];
  for (int k = 0; k < QPC_MATRIX_ENTRIES; ++k) {
    if (qpc_matrix_slot[k] >= 0) s->constant_kkt[qpc_matrix_slot[k]] = m->matrix[k];
  }
}

/* K for the present weights, and its factor; 0 if a pivot shows that H is not positive semidefinite. */
static int qpc_prepare(const qpc_matrices* m, qpc_solver* s) {
  for (int k = 0; k < QPC_KKT_ENTRIES; ++k) s->kkt[k] = s->constant_kkt[k];
  for (int j = 0; j < QPC_VARIABLES; ++j) {
    s->kkt[qpc_diagonal_slot[j]] += s->regularisation + s->weight[QPC_ROWS + j];
  }
  for (int i = 0; i < QPC_KEPT_ROWS; ++i) {
    s->kkt[qpc_diagonal_slot[QPC_VARIABLES + i]] = 
        -s->regularisation - 1.0 / (s->weight[qpc_kept_row[i]] + QPC_LEAST_WEIGHT);
  }
  for (int k = 0; k < QPC_PRODUCTS; ++k) {
    const double weight = s->weight[qpc_product_row[k]];
    s->kkt[qpc_product_slot[k]] +=
        weight * qpc_share(s, weight) * (m->matrix[qpc_product_first[k]] * m->matrix[qpc_product_second[k]]);
  }
  return qpc_factorise(s);
}

/* correction = right - K solution */
static void qpc_remainder(qpc_solver* s) {
  for (int i = 0; i < QPC_UNKNOWNS; ++i) s->correction[i] = s->right[i];
  for (int j = 0; j < QPC_UNKNOWNS; ++j) {
    const double x = s->solution[j];
    const int start = qpc_kkt_start[j]; /* the diagonal comes first */
    double sum = s->kkt[start] * x;
    for (int k = start + 1; k < qpc_kkt_start[j + 1]; ++k) {
      const int i = qpc_kkt_row[k];
      s->correction[i] -= s->kkt[k] * x;
      sum += s->kkt[k] * s->solution[i];
    }
    s->correction[j] -= sum;
  }
}

/* Solves K solution = right, with iterative refinement. */
static void qpc_solve_newton(qpc_solver* s) {
  for (int i = 0; i < QPC_UNKNOWNS; ++i) s->solution[i] = s->right[i];
  qpc_substitute(s, s->solution);
  for (int step = 0; step < QPC_REFINEMENTS; ++step) {
    qpc_remainder(s);
    qpc_substitute(s, s->correction);
    for (int i = 0; i < QPC_UNKNOWNS; ++i) s->solution[i] += s->correction[i];
  }
}

/* The steps of values and fixed pulls that the forces cause. */
static void qpc_respond(const qpc_matrices* m, qpc_solver* s) {
  double sum[QPC_VARIABLES], step[QPC_VARIABLES];
  for (int j = 0; j < QPC_VARIABLES; ++j) sum[j] = s->force[QPC_ROWS + j] - s->dual_residual[j];
  for (int r = 0; r < QPC_ROWS; ++r) {
    const int unknown = qpc_row_unknown[r];
    if (unknown >= 0) {
      s->right[unknown] = s->force[r] / (s->weight[r] + QPC_LEAST_WEIGHT);
      continue;
    }
    for (int k = qpc_matrix_start[r]; k < qpc_matrix_start[r + 1]; ++k) {
      sum[qpc_matrix_column[k]] += m->matrix[k] * s->force[r] * qpc_share(s, s->weight[r]);
    }
  }
  for (int j = 0; j < QPC_VARIABLES; ++j) s->right[qpc_variable_unknown[j]] = sum[j];
  qpc_solve_newton(s);
  for (int j = 0; j < QPC_VARIABLES; ++j) step[j] = s->solution[qpc_variable_unknown[j]];
  qpc_evaluate_places(m, step, s->value_step);
  for (int p = 0; p < QPC_PLACES; ++p) {
    const int unknown = p < QPC_ROWS ? qpc_row_unknown[p] : -1;
    const double share = p < QPC_ROWS ? qpc_share(s, s->weight[p]) : 1.0;
    const double pull = unknown >= 0 ? -s->solution[unknown] : share * (s->force[p] - s->weight[p] * s->value_step[p]);
    s->pull_step[p] = pull;
    /* A great weight would magnify the rounding of A dx: the multiplier's step says it better. */
    if (!s->fixed[p] && p < QPC_ROWS && s->weight[p] > 1.0) s->value_step[p] = (s->force[p] - pull) / s->weight[p];
  }
}
