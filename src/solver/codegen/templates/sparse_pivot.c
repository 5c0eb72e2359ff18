/* The pivot d, of which the sign is known; 0 if it has clearly the wrong one. Pivots too small to be told from 0 are
   replaced. */
QPC_FUNCTION double qpc_checked_pivot(const qpc_solver* s, double d, double sign) {
  if (sign * d > QPC_SMALLEST_PIVOT) return d;
  return sign * d > -s->wrong_pivot ? sign * s->regularisation : 0.0;
}
