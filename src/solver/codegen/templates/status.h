/* What solve and setup report. */
enum {
  QPC_SOLVED = 0,
  QPC_BAD_DATA = 1,      /* not finite, or a penalty, count or index out of range: the result is zero */
  QPC_INFEASIBLE = 2,    /* the hard rows and bounds contradict each other */
  QPC_CAP = 3,           /* a cap on changes, active rows or Newton steps was met, and no other method answered */
  QPC_NOT_CONVEX = 4,    /* the Hessian is not positive definite; of a sparse problem: not semidefinite */
  QPC_WRONG_VERSION = 5, /* setup: the caller was compiled with the header of another description */
  QPC_UNFINISHED = 6     /* with stages: `most_changes` was met; the result keeps the model, but not every row */
};
