/* One QP: data, result and work space. Fill the data after qpc_init; what is not touched stays as it was. */
typedef struct {
  /* Data. */
  double x0[QPC_STATES];
  double u_previous[QPC_INPUTS];                     /* u_{-1}; read only if there is a rate cost */
  double state_linear[QPC_HORIZON][QPC_STATES];      /* q_k of stages 1..N */
  double input_linear[QPC_HORIZON][QPC_INPUTS];      /* r_k of stages 0..N-1; read only if described */
  /* Rows n . y >= offset, by slot: see qpc_add_row and QPC_SLOT. */
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
  /* Guess: identities and multipliers of the rows thought active; 0 of them: a cold start. */
  int32_t warm_count;
  int32_t warm_id[QPC_MAX_ACTIVE];
  double warm_multiplier[QPC_MAX_ACTIVE];

  int32_t wanted_method;                             /* QPC_ACTIVE_SET, which falls back, or QPC_INTERIOR_POINT */
  double tolerance;                                  /* of the interior-point method: duality gap in the cost */
  int32_t most_changes;                              /* beyond the guess; the answer then counts as it is. 0: finish */

  /* Result. */
  double u[QPC_HORIZON][QPC_INPUTS];
  double x[QPC_HORIZON + 1][QPC_STATES];
  int32_t active_count;                              /* all other rows and bounds have multiplier 0 */
  int32_t active_id[QPC_MAX_ACTIVE];
  double multiplier[QPC_MAX_ACTIVE];
  double slack[QPC_MAX_ACTIVE];
  int32_t status;
  int32_t method;
  int32_t iterations;                                /* changes of the active set, or Newton steps */
  double gap;                                        /* the cost is above its least by no more; active set: 0, exact */

  /* Work space. */
  int32_t group_count;
  int32_t group_slot[QPC_GROUPS];
  int32_t group_rows[QPC_GROUPS];
  int32_t group_output[QPC_GROUPS];
  int32_t group_index[QPC_GROUPS];
  int32_t delicate;                                  /* nearly dependent rows were met: see qpc_is_proven */
  double group_violation[QPC_GROUPS][8];             /* by lane, as the last scan of all rows found it */
  int32_t listed_count;                              /* groups of rows that were violated then, */
  int32_t listed[QPC_GROUPS];
  int32_t listed_bounds;                             /* whether bounds were, */
  uint8_t listed_tile[QPC_TILES];                    /* and which parts of a block's outputs they need */
  int32_t scaled;                                    /* some rows are scaled for this solve, by row_scale */
  double row_scale[QPC_ROW_SLOTS];
  double free_output[QPC_BLOCKS * QPC_POINTS_PADDED];
  double output[QPC_BLOCKS * QPC_POINTS_PADDED];
  double free_input[QPC_BLOCKS][QPC_RESPONSE_PADDED];
  double input[QPC_BLOCKS][QPC_RESPONSE_PADDED];
  int32_t point[QPC_COMPONENTS][QPC_ACTIVE_PADDED];  /* flat place in `output` of each component */
  double normal[QPC_COMPONENTS][QPC_ACTIVE_PADDED];
  double target[QPC_ACTIVE_PADDED];                  /* n . y + flexibility * multiplier = target */
  double flexibility[QPC_ACTIVE_PADDED];             /* 0, or the compliance of a row in its quadratic part */
  double row_compliance[QPC_ACTIVE_PADDED];
  double row_linear[QPC_ACTIVE_PADDED];              /* where the quadratic part begins; kUnbounded: hard */
  double least[QPC_ACTIVE_PADDED];                   /* the multiplier's range in the present part */
  double most[QPC_ACTIVE_PADDED];
  double lambda[QPC_ACTIVE_PADDED];
  double offset[QPC_ACTIVE_PADDED];
  double direction[QPC_ACTIVE_PADDED];
  double column[QPC_ACTIVE_PADDED];
  double gram[QPC_ACTIVE_PADDED][QPC_ACTIVE_PADDED]; /* of the working set, as if all rows were rigid */
  double inverse_gram[QPC_ACTIVE_PADDED][QPC_ACTIVE_PADDED]; /* of gram + flexibility */
  int32_t ignored_count;                             /* rows hidden from the scan: violated by less than matters */
  int32_t ignored_id[QPC_ACTIVE_PADDED];
  double ignored_offset[QPC_ACTIVE_PADDED];
  /* Interior point: the rows and bounds that it was given, and their variables. */
  int32_t ip_count;
  int32_t ip_id[QPC_ENTRIES];
  int32_t ip_place[QPC_COMPONENTS][QPC_ENTRIES];
  int32_t ip_group[2][QPC_ENTRIES];                  /* output and stage index */
  double ip_normal[QPC_COMPONENTS][QPC_ENTRIES];
  double ip_offset[QPC_ENTRIES];
  double ip_quadratic[QPC_ENTRIES];
  double ip_self[QPC_ENTRIES];                       /* the row's own Gram entry */
  double ip_give;                                    /* proximal: how much rows give way, relative to ip_self */
  double ip_reach;                                   /* a distance in the metric of the Hessian, squared */
  uint8_t ip_hard[QPC_ENTRIES];
  double ip_variable[4][QPC_ENTRIES];                /* multiplier, room, slack (0: hard), reserve (hard: 1) */
  double ip_step[4][QPC_ENTRIES];
  double ip_inverse_room[QPC_ENTRIES];               /* 1 / (room + multiplier (slack inverse_reserve + proximal)) */
  double ip_inverse_reserve[QPC_ENTRIES];            /* 1 / (quadratic slack + reserve) */
  double ip_product[2][QPC_ENTRIES];                 /* second-order terms of the two complementarities */
  double ip_pull[QPC_ENTRIES];                       /* force along the normal */
  double ip_value[QPC_ENTRIES];                      /* n . y of the outputs' step */
  double ip_residual[QPC_ENTRIES];                   /* n . y + slack - offset - room */
  double ip_weight[QPC_OUTPUTS][QPC_WEIGHTS][QPC_STAGES_PADDED];
  double ip_force[QPC_BLOCKS * QPC_POINTS_PADDED];
  double ip_output[QPC_BLOCKS * QPC_POINTS_PADDED];
  double ip_input[QPC_HORIZON][QPC_INPUTS];          /* step of the inputs */
  double ip_gain[QPC_HORIZON][QPC_GAINS];
  double ip_lower[QPC_HORIZON][QPC_LOWERS];
  double ip_pivot[QPC_HORIZON][QPC_INPUTS];
  double ip_constant[QPC_HORIZON][QPC_INPUTS];
} qpc_solver;

/* There is one copy of the model: what concerns a copy concerns the solver. */
typedef qpc_solver qpc_copy;
