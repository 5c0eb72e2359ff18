/* ---- The data of one copy. ---- */

/* No rows, bounds as described. */
static void qpc_init_copy(qpc_copy* s, const qpc_tables* t) {
  for (int i = 0; i < QPC_BLOCKS * QPC_POINTS_PADDED; ++i) {
    s->lower[i] = t->lower[i];
    s->upper[i] = t->upper[i];
  }
  for (int o = 0; o < QPC_OUTPUTS; ++o) {
    for (int slot = qpc_first_slot[o]; slot < (o + 1 < QPC_OUTPUTS ? qpc_first_slot[o + 1] : QPC_ROW_SLOTS); ++slot) {
      qpc_neutralise(s, slot);
      s->row_penalty[slot] = (uint8_t)qpc_row_penalty[o];
    }
  }
}

static int qpc_quadratics_valid(const qpc_copy* s) {
  if (s->quadratic_count < 0 || s->quadratic_count > QPC_MAX_QUADRATIC) return 0;
  for (int i = 0; i < s->quadratic_count; ++i) {
    if (s->quadratic_output[i] < 0 || s->quadratic_output[i] >= QPC_OUTPUTS || s->quadratic_index[i] < 0 ||
        s->quadratic_index[i] >= QPC_HORIZON || !(s->quadratic_weight[i] > 0.0)) {
      return 0;
    }
    double sum = s->quadratic_offset[i] * 0.0 + 1.0 / s->quadratic_weight[i];
    for (int c = 0; c < QPC_COMPONENTS; ++c) sum += s->quadratic_normal[i][c] * 0.0;
    if (!qpc_is_finite(sum)) return 0;
  }
  return 1;
}

/* The optimum without rows, and the size of its outputs. */
static double qpc_free_response(const qpc_tables* t, qpc_copy* s) {
  double q[QPC_HORIZON][QPC_BLOCK_STATES][QPC_LANES], r[QPC_HORIZON][QPC_BLOCK_INPUTS][QPC_LANES];
  double z0[QPC_SWEEP_STATES][QPC_LANES], feedforward[QPC_HORIZON][QPC_BLOCK_INPUTS][QPC_LANES];
  qpc_gather(s, q, r, z0);
  qpc_backward(t, (const double(*)[QPC_BLOCK_STATES][QPC_LANES])q,
               QPC_INPUT_LINEAR ? (const double(*)[QPC_BLOCK_INPUTS][QPC_LANES])r : 0, feedforward);
  qpc_forward(t, (const double(*)[QPC_LANES])z0, (const double(*)[QPC_BLOCK_INPUTS][QPC_LANES])feedforward,
              s->free_input, s->free_output);
  qpc_vector largest = QPC_BROADCAST(0.0);
  for (int i = 0; i < QPC_BLOCKS * QPC_POINTS_PADDED; i += QPC_WIDTH) {
    const qpc_vector y = QPC_LOAD(&s->free_output[i]);
    largest = qpc_select((qpc_mask)(y > largest), y, largest);
    largest = qpc_select((qpc_mask)(-y > largest), -y, largest);
  }
  double size = 0.0;
  for (int i = 0; i < QPC_WIDTH; ++i) size = largest[i] > size ? largest[i] : size;
  return size;
}
