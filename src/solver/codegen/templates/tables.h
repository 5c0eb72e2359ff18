/* Which method answered. */
enum { QPC_ACTIVE_SET = 0, QPC_INTERIOR_POINT = 1 };

/* Everything that does not change between solves. Filled by setup, read-only afterwards: any number of solvers on
   any number of threads may share it. The innermost index of the stage data is the block (a "lane"). */
typedef struct {
  double a[QPC_BLOCK_STATES][QPC_BLOCK_STATES][QPC_LANES];
  double b[QPC_BLOCK_STATES][QPC_BLOCK_INPUTS][QPC_LANES];
  double stage_cost[QPC_BLOCK_STATES][QPC_BLOCK_STATES][QPC_LANES];
  double terminal_cost[QPC_BLOCK_STATES][QPC_BLOCK_STATES][QPC_LANES];
  double input_cost[QPC_BLOCK_INPUTS][QPC_BLOCK_INPUTS][QPC_LANES];
  double rate_cost[QPC_BLOCK_INPUTS][QPC_BLOCK_INPUTS][QPC_LANES];
  double c[QPC_CHANNELS][QPC_BLOCK_STATES][QPC_LANES];
  double d[QPC_CHANNELS][QPC_BLOCK_INPUTS][QPC_LANES];
  /* Riccati recursion of the problem without rows, in z = [x; previous u if there is a rate cost]:
     u = -gain z - inverse l, z+ = closed_loop z - [B; I] inverse l. */
  double closed_loop[QPC_HORIZON][QPC_SWEEP_STATES][QPC_SWEEP_STATES][QPC_LANES];
  double gain[QPC_HORIZON][QPC_BLOCK_INPUTS][QPC_SWEEP_STATES][QPC_LANES];
  double inverse[QPC_HORIZON][QPC_BLOCK_INPUTS][QPC_BLOCK_INPUTS][QPC_LANES];
  /* Per class of blocks: gram = G H^-1 G' between points (channel * QPC_HORIZON + stage index), and
     response = H^-1 G', a column of inputs per point. */
  double gram[QPC_CLASSES][QPC_POINTS][QPC_POINTS_PADDED];
  double response[QPC_CLASSES][QPC_POINTS][QPC_RESPONSE_PADDED];
  double lower[QPC_BLOCKS * QPC_POINTS_PADDED];
  double upper[QPC_BLOCKS * QPC_POINTS_PADDED];
  double penalty_linear[QPC_PENALTIES + 1]; /* [0]: hard */
  double compliance[QPC_PENALTIES + 1];     /* 1 / quadratic weight; hard: 0 */
} qpc_tables;
