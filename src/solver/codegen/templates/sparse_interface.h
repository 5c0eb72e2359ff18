/* The functions, one set for every instruction set that an object was compiled for:
   default_parameters  the description's values
   setup               all tables, for these parameters; `hash` is QPC_HASH as the caller's header has it
   init                the description's numbers, cold start
   hessian_index       place in solver->hessian of the entry (row, column), or its mirror image; -1 if it does not vary
   matrix_index        the same for solver->matrix; rows are counted as in QPC_ROW_NAME
   solve               the optimum; returns the status, which is also stored
   No function keeps anything outside its arguments. */
#define QPC_DECLARE(set)                                                               \
  void qpc_default_parameters_##set(qpc_parameters* parameters);                       \
  int qpc_setup_##set(qpc_tables* tables, const qpc_parameters* parameters, uint64_t hash); \
  void qpc_init_##set(qpc_solver* solver, const qpc_tables* tables);                   \
  int qpc_hessian_index_##set(int row, int column);                                    \
  int qpc_matrix_index_##set(int row, int column);                                     \
  int qpc_solve_##set(const qpc_tables* tables, qpc_solver* solver);
