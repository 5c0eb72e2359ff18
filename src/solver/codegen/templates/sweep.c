/* ---- The problem without rows: one backward and one forward sweep, all blocks in lanes. ---- */

/* Backward: costate = q + closed_loop' costate+ - gain' r; feedforward = inverse (r + [B; I]' costate+). */
QPC_FUNCTION void qpc_backward(const qpc_tables* t, const double (*q)[QPC_BLOCK_STATES][QPC_LANES],
                               const double (*r)[QPC_BLOCK_INPUTS][QPC_LANES],
                               double (*feedforward)[QPC_BLOCK_INPUTS][QPC_LANES]) {
  qpc_lane costate[QPC_SWEEP_STATES], next[QPC_SWEEP_STATES], slope[QPC_BLOCK_INPUTS];
  for (int i = 0; i < QPC_SWEEP_STATES; ++i) costate[i] = QPC_LANE_ZERO;
  for (int i = 0; i < QPC_BLOCK_STATES; ++i) costate[i] = QPC_LOAD_LANE(q[QPC_HORIZON - 1][i]);
  for (int k = QPC_HORIZON - 1; k >= 0; --k) {
    for (int j = 0; j < QPC_BLOCK_INPUTS; ++j) {
      qpc_lane sum = r ? QPC_LOAD_LANE(r[k][j]) : QPC_LANE_ZERO;
#if QPC_RATE
      sum += costate[QPC_BLOCK_STATES + j];
#endif
      for (int i = 0; i < QPC_BLOCK_STATES; ++i) sum += QPC_LOAD_LANE(t->b[i][j]) * costate[i];
      slope[j] = sum;
    }
    for (int j = 0; j < QPC_BLOCK_INPUTS; ++j) {
      qpc_lane sum = QPC_LOAD_LANE(t->inverse[k][j][0]) * slope[0];
      for (int i = 1; i < QPC_BLOCK_INPUTS; ++i) sum += QPC_LOAD_LANE(t->inverse[k][j][i]) * slope[i];
      QPC_STORE_LANE(feedforward[k][j], sum);
    }
    if (k == 0) break;
    for (int i = 0; i < QPC_SWEEP_STATES; ++i) {
      qpc_lane sum = i < QPC_BLOCK_STATES ? QPC_LOAD_LANE(q[k - 1][i < QPC_BLOCK_STATES ? i : 0]) : QPC_LANE_ZERO;
      if (r) {
        for (int j = 0; j < QPC_BLOCK_INPUTS; ++j) sum -= QPC_LOAD_LANE(t->gain[k][j][i]) * QPC_LOAD_LANE(r[k][j]);
      }
      for (int j = 0; j < QPC_SWEEP_STATES; ++j) sum += QPC_LOAD_LANE(t->closed_loop[k][j][i]) * costate[j];
      next[i] = sum;
    }
    for (int i = 0; i < QPC_SWEEP_STATES; ++i) costate[i] = next[i];
  }
}

/* Forward: u = -gain z - feedforward, z+ = closed_loop z - [B; I] feedforward. Writes every channel's value at every
   point, and the inputs. */
QPC_FUNCTION void qpc_forward(const qpc_tables* t, const double (*z0)[QPC_LANES],
                              const double (*feedforward)[QPC_BLOCK_INPUTS][QPC_LANES],
                              double (*input)[QPC_RESPONSE_PADDED], double* output) {
  qpc_lane z[QPC_SWEEP_STATES], next[QPC_SWEEP_STATES], u[QPC_BLOCK_INPUTS], channel[QPC_CHANNELS];
  for (int i = 0; i < QPC_SWEEP_STATES; ++i) z[i] = QPC_LOAD_LANE(z0[i]);
  for (int k = 0; k < QPC_HORIZON; ++k) {
    for (int j = 0; j < QPC_BLOCK_INPUTS; ++j) {
      qpc_lane sum = -QPC_LOAD_LANE(feedforward[k][j]);
      for (int i = 0; i < QPC_SWEEP_STATES; ++i) sum -= QPC_LOAD_LANE(t->gain[k][j][i]) * z[i];
      u[j] = sum;
    }
    for (int i = 0; i < QPC_SWEEP_STATES; ++i) {
      qpc_lane sum = QPC_LOAD_LANE(t->closed_loop[k][i][0]) * z[0];
      for (int j = 1; j < QPC_SWEEP_STATES; ++j) sum += QPC_LOAD_LANE(t->closed_loop[k][i][j]) * z[j];
      for (int j = 0; j < QPC_BLOCK_INPUTS; ++j) {
        if (i < QPC_BLOCK_STATES) {
          sum -= QPC_LOAD_LANE(t->b[i < QPC_BLOCK_STATES ? i : 0][j]) * QPC_LOAD_LANE(feedforward[k][j]);
        } else if (i - QPC_BLOCK_STATES == j) {
          sum -= QPC_LOAD_LANE(feedforward[k][j]);
        }
      }
      next[i] = sum;
    }
    qpc_channels(t, z, next, u, channel);
    for (int b = 0; b < QPC_BLOCKS; ++b) {
      for (int i = 0; i < QPC_CHANNELS; ++i) {
        output[b * QPC_POINTS_PADDED + i * QPC_HORIZON + k] = QPC_LANE_ENTRY(channel[i], b);
      }
      for (int j = 0; j < QPC_BLOCK_INPUTS; ++j) input[b][k * QPC_BLOCK_INPUTS + j] = QPC_LANE_ENTRY(u[j], b);
    }
    for (int i = 0; i < QPC_SWEEP_STATES; ++i) z[i] = next[i];
  }
}

/* The outputs that given inputs lead to, step by step from the start. */
static void qpc_simulate(const qpc_tables* t, const double (*z0)[QPC_LANES], const double (*input)[QPC_RESPONSE_PADDED],
                         double* output) {
  qpc_lane z[QPC_SWEEP_STATES], next[QPC_SWEEP_STATES], u[QPC_BLOCK_INPUTS], channel[QPC_CHANNELS];
  for (int i = 0; i < QPC_SWEEP_STATES; ++i) z[i] = next[i] = QPC_LOAD_LANE(z0[i]);
  for (int k = 0; k < QPC_HORIZON; ++k) {
    for (int j = 0; j < QPC_BLOCK_INPUTS; ++j) {
      double entries[QPC_LANES] = {0};
      for (int b = 0; b < QPC_BLOCKS; ++b) entries[b] = input[b][k * QPC_BLOCK_INPUTS + j];
      u[j] = QPC_LOAD_LANE(entries);
    }
    for (int i = 0; i < QPC_BLOCK_STATES; ++i) {
      qpc_lane sum = QPC_LOAD_LANE(t->a[i][0]) * z[0];
      for (int j = 1; j < QPC_BLOCK_STATES; ++j) sum += QPC_LOAD_LANE(t->a[i][j]) * z[j];
      for (int j = 0; j < QPC_BLOCK_INPUTS; ++j) sum += QPC_LOAD_LANE(t->b[i][j]) * u[j];
      next[i] = sum;
    }
    qpc_channels(t, z, next, u, channel);
    for (int b = 0; b < QPC_BLOCKS; ++b) {
      for (int i = 0; i < QPC_CHANNELS; ++i) {
        output[b * QPC_POINTS_PADDED + i * QPC_HORIZON + k] = QPC_LANE_ENTRY(channel[i], b);
      }
    }
    for (int i = 0; i < QPC_BLOCK_STATES; ++i) z[i] = next[i];
  }
}
