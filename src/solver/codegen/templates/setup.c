/* ---- Set-up: stage data from the parameters, Riccati recursion, tables. ---- */

/* Inverse of the symmetric positive definite matrix f (by Gauss-Jordan on its diagonal pivots, which a positive
   definite matrix keeps positive); 0 if it is not. */
static int qpc_invert(double f[QPC_BLOCK_INPUTS][QPC_BLOCK_INPUTS], double inverse[QPC_BLOCK_INPUTS][QPC_BLOCK_INPUTS]) {
  double largest = 0.0;
  for (int i = 0; i < QPC_BLOCK_INPUTS; ++i) {
    if (f[i][i] > largest) largest = f[i][i];
    for (int j = 0; j < QPC_BLOCK_INPUTS; ++j) inverse[i][j] = i == j ? 1.0 : 0.0;
  }
  for (int p = 0; p < QPC_BLOCK_INPUTS; ++p) {
    const double pivot = f[p][p];
    if (!(pivot > 1e-14 * largest) || !qpc_is_finite(pivot)) return 0;
    for (int j = 0; j < QPC_BLOCK_INPUTS; ++j) {
      f[p][j] /= pivot;
      inverse[p][j] /= pivot;
    }
    for (int i = 0; i < QPC_BLOCK_INPUTS; ++i) {
      const double factor = f[i][p];
      if (i == p) continue;
      for (int j = 0; j < QPC_BLOCK_INPUTS; ++j) {
        f[i][j] -= factor * f[p][j];
        inverse[i][j] -= factor * inverse[p][j];
      }
    }
  }
  return 1;
}

/* The transition of z = [x; previous u] in one block. */
static void qpc_transition(const qpc_tables* t, int block, double a[QPC_SWEEP_STATES][QPC_SWEEP_STATES],
                           double b[QPC_SWEEP_STATES][QPC_BLOCK_INPUTS]) {
  for (int i = 0; i < QPC_SWEEP_STATES; ++i) {
    for (int j = 0; j < QPC_SWEEP_STATES; ++j) {
      a[i][j] = i < QPC_BLOCK_STATES && j < QPC_BLOCK_STATES ? t->a[i % QPC_BLOCK_STATES][j % QPC_BLOCK_STATES][block] : 0.0;
    }
    for (int j = 0; j < QPC_BLOCK_INPUTS; ++j) {
      b[i][j] = i < QPC_BLOCK_STATES ? t->b[i % QPC_BLOCK_STATES][j][block] : (i - QPC_BLOCK_STATES == j ? 1.0 : 0.0);
    }
  }
}

/* One step back: cost-to-go p of stage k+1 becomes that of stage k; stores the stage's gains. */
static int qpc_riccati_step(qpc_tables* t, int block, int k, double p[QPC_SWEEP_STATES][QPC_SWEEP_STATES]) {
  double a[QPC_SWEEP_STATES][QPC_SWEEP_STATES], b[QPC_SWEEP_STATES][QPC_BLOCK_INPUTS];
  double pa[QPC_SWEEP_STATES][QPC_SWEEP_STATES], f[QPC_BLOCK_INPUTS][QPC_BLOCK_INPUTS];
  double g[QPC_BLOCK_INPUTS][QPC_SWEEP_STATES], inverse[QPC_BLOCK_INPUTS][QPC_BLOCK_INPUTS];
  qpc_transition(t, block, a, b);
  for (int i = 0; i < QPC_SWEEP_STATES; ++i) {
    for (int j = 0; j < QPC_SWEEP_STATES; ++j) {
      pa[i][j] = 0.0;
      for (int l = 0; l < QPC_SWEEP_STATES; ++l) pa[i][j] += p[i][l] * a[l][j];
    }
  }
  for (int i = 0; i < QPC_BLOCK_INPUTS; ++i) {
    for (int j = 0; j < QPC_BLOCK_INPUTS; ++j) {
      f[i][j] = t->input_cost[i][j][block] + t->rate_cost[i][j][block];
      for (int l = 0; l < QPC_SWEEP_STATES; ++l) {
        for (int m = 0; m < QPC_SWEEP_STATES; ++m) f[i][j] += b[l][i] * p[l][m] * b[m][j];
      }
    }
    for (int j = 0; j < QPC_SWEEP_STATES; ++j) {
      g[i][j] = QPC_RATE && j >= QPC_BLOCK_STATES ? -t->rate_cost[i][j >= QPC_BLOCK_STATES ? j - QPC_BLOCK_STATES : 0][block] : 0.0;
      for (int l = 0; l < QPC_SWEEP_STATES; ++l) g[i][j] += b[l][i] * pa[l][j];
    }
  }
  if (!qpc_invert(f, inverse)) return 0;
  for (int i = 0; i < QPC_BLOCK_INPUTS; ++i) {
    for (int j = 0; j < QPC_BLOCK_INPUTS; ++j) t->inverse[k][i][j][block] = inverse[i][j];
    for (int j = 0; j < QPC_SWEEP_STATES; ++j) {
      double sum = 0.0;
      for (int l = 0; l < QPC_BLOCK_INPUTS; ++l) sum += inverse[i][l] * g[l][j];
      t->gain[k][i][j][block] = sum;
    }
  }
  for (int i = 0; i < QPC_SWEEP_STATES; ++i) {
    for (int j = 0; j < QPC_SWEEP_STATES; ++j) {
      double closed = a[i][j];
      for (int l = 0; l < QPC_BLOCK_INPUTS; ++l) closed -= b[i][l] * t->gain[k][l][j][block];
      t->closed_loop[k][i][j][block] = closed;
    }
  }
  for (int i = 0; i < QPC_SWEEP_STATES; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = 0.0;
      if (i < QPC_BLOCK_STATES && j < QPC_BLOCK_STATES) {
        sum = t->stage_cost[i % QPC_BLOCK_STATES][j % QPC_BLOCK_STATES][block];
      } else if (i >= QPC_BLOCK_STATES && j >= QPC_BLOCK_STATES) {
        sum = t->rate_cost[(i - QPC_BLOCK_STATES) % QPC_BLOCK_INPUTS][(j - QPC_BLOCK_STATES) % QPC_BLOCK_INPUTS][block];
      }
      for (int l = 0; l < QPC_SWEEP_STATES; ++l) sum += a[l][i] * pa[l][j];
      for (int l = 0; l < QPC_BLOCK_INPUTS; ++l) sum -= g[l][i] * t->gain[k][l][j][block];
      p[i][j] = sum;
    }
  }
  for (int i = 0; i < QPC_SWEEP_STATES; ++i) {
    for (int j = 0; j < i; ++j) p[j][i] = p[i][j];
  }
  return 1;
}

static int qpc_riccati(qpc_tables* t, int block) {
  double p[QPC_SWEEP_STATES][QPC_SWEEP_STATES];
  for (int i = 0; i < QPC_SWEEP_STATES; ++i) {
    for (int j = 0; j < QPC_SWEEP_STATES; ++j) {
      p[i][j] = i < QPC_BLOCK_STATES && j < QPC_BLOCK_STATES
                    ? t->terminal_cost[i % QPC_BLOCK_STATES][j % QPC_BLOCK_STATES][block]
                    : 0.0;
    }
  }
  for (int k = QPC_HORIZON - 1; k >= 0; --k) {
    if (!qpc_riccati_step(t, block, k, p)) return 0;
  }
  return 1;
}

/* Columns of gram and response: a unit force at one point, in all blocks at once. */
static void qpc_table_columns(qpc_tables* t, int channel, int index) {
  double q[QPC_HORIZON][QPC_BLOCK_STATES][QPC_LANES], r[QPC_HORIZON][QPC_BLOCK_INPUTS][QPC_LANES];
  double z0[QPC_SWEEP_STATES][QPC_LANES], feedforward[QPC_HORIZON][QPC_BLOCK_INPUTS][QPC_LANES];
  double input[QPC_BLOCKS][QPC_RESPONSE_PADDED], output[QPC_BLOCKS * QPC_POINTS_PADDED];
  const int state_index = qpc_channel_first_stage[channel] + index - 1; /* stage 0 is given: no force acts there */
  qpc_clear(&q[0][0][0], QPC_HORIZON * QPC_BLOCK_STATES * QPC_LANES);
  qpc_clear(&r[0][0][0], QPC_HORIZON * QPC_BLOCK_INPUTS * QPC_LANES);
  qpc_clear(&z0[0][0], QPC_SWEEP_STATES * QPC_LANES);
  qpc_clear(&input[0][0], QPC_BLOCKS * QPC_RESPONSE_PADDED);
  qpc_clear(output, QPC_BLOCKS * QPC_POINTS_PADDED);
  for (int b = 0; b < QPC_BLOCKS; ++b) {
    for (int i = 0; i < QPC_BLOCK_STATES && state_index >= 0; ++i) q[state_index][i][b] = -t->c[channel][i][b];
    for (int j = 0; j < QPC_BLOCK_INPUTS; ++j) r[index][j][b] = -t->d[channel][j][b];
  }
  qpc_backward(t, (const double(*)[QPC_BLOCK_STATES][QPC_LANES])q, (const double(*)[QPC_BLOCK_INPUTS][QPC_LANES])r,
               feedforward);
  qpc_forward(t, (const double(*)[QPC_LANES])z0, (const double(*)[QPC_BLOCK_INPUTS][QPC_LANES])feedforward, input,
              output);
  const int point = channel * QPC_HORIZON + index;
  for (int c = 0; c < QPC_CLASSES; ++c) {
    const int b = qpc_class_block[c];
    for (int i = 0; i < QPC_POINTS_PADDED; ++i) t->gram[c][point][i] = output[b * QPC_POINTS_PADDED + i];
    for (int i = 0; i < QPC_RESPONSE_PADDED; ++i) t->response[c][point][i] = input[b][i];
  }
}

int qpc_function(setup)(qpc_tables* t, const qpc_parameters* p, uint64_t hash) {
  if (hash != QPC_HASH) return QPC_WRONG_VERSION;
  qpc_clear((double*)t, (int)(sizeof *t / sizeof(double)));
  qpc_evaluate(t, p);
  const double* numbers = (const double*)t;
  for (int i = 0; i < (int)(sizeof *t / sizeof(double)); ++i) {
    if (!qpc_is_finite(numbers[i])) return QPC_BAD_DATA;
  }
  for (int i = 1; i <= QPC_PENALTIES; ++i) {
    if (!(t->penalty_linear[i] >= 0.0) || !(t->compliance[i] > 0.0)) return QPC_BAD_DATA;
  }
  for (int b = 0; b < QPC_LANES; ++b) {
    if (!qpc_riccati(t, b)) return QPC_NOT_CONVEX;
  }
  for (int channel = 0; channel < QPC_CHANNELS; ++channel) {
    for (int index = 0; index < QPC_HORIZON; ++index) qpc_table_columns(t, channel, index);
  }
  return QPC_SOLVED;
}
