/* One copy of the model: its data, its part of the result, and work space. Fill the data after qpc_init; what is not
   touched stays as it was. */
typedef struct {
  /* Data. */
  double x0[QPC_STATES];
  double u_previous[QPC_INPUTS];                     /* u_{-1}; read only if there is a rate cost */
  double state_linear[QPC_HORIZON][QPC_STATES];      /* q_k of stages 1..N */
  double input_linear[QPC_HORIZON][QPC_INPUTS];      /* r_k of stages 0..N-1; read only if described */
  /* Rows n . y >= offset of this copy alone, by slot: see qpc_add_row and QPC_SLOT. */
  int32_t row_count[QPC_OUTPUTS][QPC_HORIZON];       /* rows of an output at a stage index */
  double row_normal[QPC_COMPONENTS][QPC_ROW_SLOTS];
  double row_offset[QPC_ROW_SLOTS];
  uint8_t row_penalty[QPC_ROW_SLOTS];
  /* Bounds of the outputs, by block and point; setup's values after qpc_init. */
  double lower[QPC_BLOCKS * QPC_POINTS_PADDED];
  double upper[QPC_BLOCKS * QPC_POINTS_PADDED];
  /* Terms 1/2 weight (n . y - offset)^2. */
  int32_t quadratic_count;
  int32_t quadratic_output[QPC_MAX_QUADRATIC + 1];
  int32_t quadratic_index[QPC_MAX_QUADRATIC + 1];    /* stage index */
  double quadratic_normal[QPC_MAX_QUADRATIC + 1][QPC_COMPONENTS];
  double quadratic_offset[QPC_MAX_QUADRATIC + 1];
  double quadratic_weight[QPC_MAX_QUADRATIC + 1];

  /* Result. */
  double u[QPC_HORIZON][QPC_INPUTS];
  double x[QPC_HORIZON + 1][QPC_STATES];

  /* Work space. */
  int32_t group_count;
  int32_t group_slot[QPC_GROUPS];
  int32_t group_rows[QPC_GROUPS];
  int32_t group_output[QPC_GROUPS];
  int32_t group_index[QPC_GROUPS];
  double group_violation[QPC_GROUPS][8];             /* by lane, as the last scan of all rows found it */
  int32_t listed_count;                              /* groups of rows that were violated then, */
  int32_t listed[QPC_GROUPS];
  int32_t listed_bounds;                             /* whether bounds were, */
  uint8_t listed_tile[QPC_TILES];                    /* and which parts of a block's outputs they need */
  int32_t iterations;                                /* the solver's */
  int32_t scaled;                                    /* some rows are scaled for this solve, by row_scale */
  double row_scale[QPC_ROW_SLOTS];
  double* free_output;                               /* the copy's parts of the solver's, while it solves */
  double* output;
  double free_input[QPC_BLOCKS][QPC_RESPONSE_PADDED];
  double input[QPC_BLOCKS][QPC_RESPONSE_PADDED];
} qpc_copy;

/* One QP of several copies: data, result and work space. */
typedef struct {
  /* Data. */
  int32_t copy_count;                                /* those in use, the first ones */
  qpc_copy copy[QPC_COPIES];
  /* Couplings n[0] . y of one copy + n[1] . y of another >= offset, of the same output and stage: see
     qpc_add_coupling. */
  int32_t coupling_count;
  int32_t coupling_copy[2][QPC_MAX_COUPLINGS];
  int32_t coupling_output[QPC_MAX_COUPLINGS];
  int32_t coupling_index[QPC_MAX_COUPLINGS];         /* stage index */
  double coupling_normal[2][QPC_COMPONENTS][QPC_MAX_COUPLINGS];
  double coupling_offset[QPC_MAX_COUPLINGS];
  uint8_t coupling_penalty[QPC_MAX_COUPLINGS];
  /* Guess: identities (see QPC_ID, QPC_COUPLING_ID) and multipliers of the rows thought active. */
  int32_t warm_count;
  int32_t warm_id[QPC_MAX_ACTIVE];
  double warm_multiplier[QPC_MAX_ACTIVE];
  int32_t most_changes;                              /* beyond the guess; the answer then counts as it is. 0: finish */

  /* Result, besides the copies'. */
  int32_t active_count;                              /* all other rows and bounds have multiplier 0 */
  int32_t active_id[QPC_MAX_ACTIVE];
  double multiplier[QPC_MAX_ACTIVE];
  double slack[QPC_MAX_ACTIVE];
  int32_t status;
  int32_t iterations;                                /* changes of the active set */

  /* Work space: see the solver of one copy. */
  int32_t quadratic_count;                           /* of all copies */
  int32_t delicate;
  int32_t coupling_place[QPC_ROW_COMPONENTS][QPC_MAX_COUPLINGS];
  double coupling_scale[QPC_MAX_COUPLINGS];
  int32_t listed_count;                              /* of all copies, with the couplings */
  int32_t listed_bounds;
  int32_t listed_couplings;
  int32_t listed_coupling[QPC_MAX_COUPLINGS];
  double free_output[QPC_COPIES * QPC_COPY_OUTPUTS];
  double output[QPC_COPIES * QPC_COPY_OUTPUTS];
  int32_t point[QPC_ROW_COMPONENTS][QPC_ACTIVE_PADDED];
  double normal[QPC_ROW_COMPONENTS][QPC_ACTIVE_PADDED];
  double target[QPC_ACTIVE_PADDED];
  double flexibility[QPC_ACTIVE_PADDED];
  double row_compliance[QPC_ACTIVE_PADDED];
  double row_linear[QPC_ACTIVE_PADDED];
  double least[QPC_ACTIVE_PADDED];
  double most[QPC_ACTIVE_PADDED];
  double lambda[QPC_ACTIVE_PADDED];
  double offset[QPC_ACTIVE_PADDED];
  double direction[QPC_ACTIVE_PADDED];
  double column[QPC_ACTIVE_PADDED];
  double gram[QPC_ACTIVE_PADDED][QPC_ACTIVE_PADDED];
  double inverse_gram[QPC_ACTIVE_PADDED][QPC_ACTIVE_PADDED];
  int32_t ignored_count;
  int32_t ignored_id[QPC_ACTIVE_PADDED];
  double ignored_offset[QPC_ACTIVE_PADDED];
} qpc_solver;

/* Identities in active_id and warm_id: of a copy's row (as qpc_add_row gives it) or bound, and of a coupling. */
#define QPC_ID(copy, id) ((copy) * QPC_COPY_IDS + (id))
#define QPC_COUPLING_ID(i) (QPC_COPIES * QPC_COPY_IDS + (i))
