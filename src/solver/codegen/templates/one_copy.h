/* The functions, one set for every instruction set that an object was compiled for:
   default_parameters  the description's values
   setup               all tables, for these parameters; `hash` is QPC_HASH as the caller's header has it
   init                no rows, no linear terms, cold start, bounds as described
   set_rows            all rows of an output at a stage index at once, from single-precision records (a normal of
                       QPC_COMPONENTS each); penalties as they were
   solve               the optimum; returns the status, which is also stored
   No function keeps anything outside its arguments. */
#define QPC_DECLARE(set)                                                               \
  void qpc_default_parameters_##set(qpc_parameters* parameters);                       \
  int qpc_setup_##set(qpc_tables* tables, const qpc_parameters* parameters, uint64_t hash); \
  void qpc_init_##set(qpc_solver* solver, const qpc_tables* tables);                   \
  void qpc_set_rows_##set(qpc_solver* solver, int output, int index, int count, const float* normals, \
                          const float* offsets);                                       \
  int qpc_solve_##set(const qpc_tables* tables, qpc_solver* solver);
