/* Appends the coupling normal[0] . y(copy[0]) + normal[1] . y(copy[1]) >= offset on an output's values at a stage;
   returns its number (see QPC_COUPLING_ID), or -1 if the stage does not have the output or there is no more room. */
static inline int qpc_add_coupling(qpc_solver* s, int output, int stage, const int* copy, const double* const* normal,
                                   double offset, int penalty) {
  const int index = stage - qpc_first_stage(output), i = s->coupling_count;
  if (index < 0 || index >= QPC_HORIZON || i >= QPC_MAX_COUPLINGS) return -1;
  s->coupling_count = i + 1;
  for (int part = 0; part < 2; ++part) {
    s->coupling_copy[part][i] = copy[part];
    for (int c = 0; c < QPC_COMPONENTS; ++c) s->coupling_normal[part][c][i] = normal[part][c];
  }
  s->coupling_output[i] = output;
  s->coupling_index[i] = index;
  s->coupling_offset[i] = offset;
  s->coupling_penalty[i] = (uint8_t)penalty;
  return i;
}

/* The functions, one set for every instruction set that an object was compiled for:
   default_parameters  the description's values
   setup               all tables, for these parameters; `hash` is QPC_HASH as the caller's header has it
   init                `copies` copies without rows and linear terms, no couplings, cold start
   init_copy           one copy without rows, bounds as these tables have them
   solve               the optimum, each copy with its own tables, which may be the same for all, and for which
                       init_copy was called; returns the status, which is also stored
   No function keeps anything outside its arguments. */
#define QPC_DECLARE(set)                                                                    \
  void qpc_default_parameters_##set(qpc_parameters* parameters);                            \
  int qpc_setup_##set(qpc_tables* tables, const qpc_parameters* parameters, uint64_t hash); \
  void qpc_init_##set(qpc_solver* solver, int copies);                                      \
  void qpc_init_copy_##set(qpc_copy* copy, const qpc_tables* tables);                       \
  int qpc_solve_##set(const qpc_tables* const* tables, qpc_solver* solver);
