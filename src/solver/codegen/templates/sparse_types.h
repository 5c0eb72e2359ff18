enum { QPC_NO_MINIMUM = 6 /* the cost falls without end along a direction that no row or bound blocks */ };

#define QPC_AT_LEAST_ONE(n) ((n) > 0 ? (n) : 1)

/* H (its lower triangle) and A, row by row in ascending columns, so scaled by powers of two that their entries are
   about 1: x = variable_scale * scaled x, and row r of A is multiplied by row_scale[r]. */
typedef struct {
  double hessian[QPC_AT_LEAST_ONE(QPC_HESSIAN_ENTRIES)];
  double matrix[QPC_AT_LEAST_ONE(QPC_MATRIX_ENTRIES)];
  double variable_scale[QPC_VARIABLES];
  double row_scale[QPC_AT_LEAST_ONE(QPC_ROWS)];
} qpc_matrices;

/* Everything that does not change between solves. Filled by setup, read-only afterwards: any number of solvers on
   any number of threads may share it. */
typedef struct {
  double hessian[QPC_AT_LEAST_ONE(QPC_HESSIAN_ENTRIES)]; /* as described; where it varies: 0 */
  double matrix[QPC_AT_LEAST_ONE(QPC_MATRIX_ENTRIES)];
  qpc_matrices scaled;                                   /* used where no entry varies */
  double linear[QPC_VARIABLES];
  double lower[QPC_VARIABLES];
  double upper[QPC_VARIABLES];
  double row_lower[QPC_AT_LEAST_ONE(QPC_ROWS)];
  double row_upper[QPC_AT_LEAST_ONE(QPC_ROWS)];
  double penalty_linear[QPC_PENALTIES + 1]; /* [0]: hard */
  double penalty_quadratic[QPC_PENALTIES + 1];
} qpc_tables;

/* One QP: data, result and work space. Fill the data after qpc_init, which puts the description's numbers there; what
   is not touched stays as it was. Bounds of +-1e300 or +-infinity are none. A bound that the description says does not
   exist is not read. */
typedef struct {
  /* Data. */
  double linear[QPC_VARIABLES];                          /* g */
  double lower[QPC_VARIABLES];                           /* lower <= x <= upper */
  double upper[QPC_VARIABLES];
  double row_lower[QPC_AT_LEAST_ONE(QPC_ROWS)];          /* row_lower <= A x <= row_upper; of an equality, */
  double row_upper[QPC_AT_LEAST_ONE(QPC_ROWS)];          /* the first QPC_EQUALITIES, row_lower is the right side */
  uint8_t row_penalty[QPC_AT_LEAST_ONE(QPC_ROWS)];       /* QPC_HARD or QPC_PENALTY_NAME; equalities are hard */
  double hessian[QPC_AT_LEAST_ONE(QPC_HESSIAN_VARYING)]; /* the entries that vary, see qpc_hessian_index */
  double matrix[QPC_AT_LEAST_ONE(QPC_MATRIX_VARYING)];   /* the same of A, see qpc_matrix_index */
  /* Guess, e.g. the last result; read if warm is not 0. */
  int32_t warm;
  double warm_x[QPC_VARIABLES];
  double warm_row_multiplier[QPC_AT_LEAST_ONE(QPC_ROWS)];
  double warm_bound_multiplier[QPC_VARIABLES];

  double tolerance; /* of the residuals and the duality gap, relative to the terms that they are made of */

  /* Result. H x + g = A' row_multiplier + bound_multiplier: a multiplier is positive where a lower bound holds x back,
     negative at an upper one. */
  double x[QPC_VARIABLES];
  double row_multiplier[QPC_AT_LEAST_ONE(QPC_ROWS)];
  double bound_multiplier[QPC_VARIABLES];
  double objective;                                      /* with the penalties */
  double residual;                                       /* largest of the residuals and the gap, relative */
  int32_t status;
  int32_t iterations;                                    /* Newton steps */

  /* Work space; everything is scaled. Places are the rows, then the variables; a side is a bound of a place. */
  qpc_matrices own;                                      /* used where entries vary */
  double cost_scale;
  double position[QPC_VARIABLES];
  double gradient[QPC_VARIABLES];                        /* g */
  double slope[QPC_VARIABLES];                           /* H x */
  double dual_residual[QPC_VARIABLES];                   /* H x + g - A' y - z */
  double value[QPC_PLACES];                              /* A x, x */
  double pull[QPC_PLACES];                               /* y, z */
  double weight[QPC_PLACES];                             /* of Newton's equations: d pull = force - weight d value */
  double force[QPC_PLACES];
  double value_step[QPC_PLACES];
  double pull_step[QPC_PLACES];                          /* of fixed places */
  uint8_t fixed[QPC_PLACES];                             /* equalities, and places whose two bounds are the same */
  double target[QPC_PLACES];                             /* of fixed places */
  int32_t side_count;
  int32_t side_place[QPC_AT_LEAST_ONE(QPC_SIDES)];
  double side_sign[QPC_AT_LEAST_ONE(QPC_SIDES)];         /* 1: lower, -1: upper */
  double side_offset[QPC_AT_LEAST_ONE(QPC_SIDES)];       /* sign * value + slack >= offset */
  double side_soft[QPC_AT_LEAST_ONE(QPC_SIDES)];         /* 1: slack and reserve are variables */
  double side_linear[QPC_AT_LEAST_ONE(QPC_SIDES)];
  double side_quadratic[QPC_AT_LEAST_ONE(QPC_SIDES)];
  double side_variable[4][QPC_AT_LEAST_ONE(QPC_SIDES)];  /* multiplier, room, slack, reserve */
  double side_step[4][QPC_AT_LEAST_ONE(QPC_SIDES)];
  double side_residual[QPC_AT_LEAST_ONE(QPC_SIDES)];     /* sign * value + slack - offset - room */
  double side_inverse_room[QPC_AT_LEAST_ONE(QPC_SIDES)];
  double side_inverse_reserve[QPC_AT_LEAST_ONE(QPC_SIDES)];
  double side_force[QPC_AT_LEAST_ONE(QPC_SIDES)];
  double side_product[2][QPC_AT_LEAST_ONE(QPC_SIDES)];   /* second-order terms of the two complementarities */
  double constant_kkt[QPC_KKT_ENTRIES];                  /* without the weights */
  double kkt[QPC_KKT_ENTRIES];
  double regularisation;                                 /* of K's diagonal */
  double damping;                                        /* of the regularisation */
  double wrong_pivot;                                    /* of the wrong sign and greater: H is not convex */
  double factor[QPC_FACTOR_ROOM];
  double pivot[QPC_UNKNOWNS];
  double inverse_pivot[QPC_UNKNOWNS];
  double update[QPC_UPDATE_ROOM];
  double right[QPC_UNKNOWNS];
  double solution[QPC_UNKNOWNS];
  double correction[QPC_UNKNOWNS];
} qpc_solver;
