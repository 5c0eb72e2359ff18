/* Square root; 0 for a number that is not positive. */
static double qpc_root(double square) {
  double root = 1.0;
  while (square > 0.0 && root * root < square) root *= 2.0;
  while (square > 0.0 && root * root > 4.0 * square) root *= 0.5;
  for (int i = 0; i < 6 && square > 0.0; ++i) root = 0.5 * (root + square / root);
  return square > 0.0 ? root : 0.0;
}
