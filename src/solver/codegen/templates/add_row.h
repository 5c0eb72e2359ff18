  const int index = stage - first_stage[output];
  if (index < 0 || index >= QPC_HORIZON || s->row_count[output][index] >= most_rows[output]) return -1;
  const int slot =
      first_slot[output] + index * stage_stride[output] + s->row_count[output][index]++ * row_stride[output];
  for (int c = 0; c < QPC_COMPONENTS; ++c) s->row_normal[c][slot] = normal[c];
  s->row_offset[slot] = offset;
  s->row_penalty[slot] = (uint8_t)penalty;
  return slot;
}

/* Forgets all rows; bounds, linear terms and the guess stay. */
static inline void qpc_clear_rows(qpc_copy* s) {
  for (int o = 0; o < QPC_OUTPUTS; ++o) {
    for (int k = 0; k < QPC_HORIZON; ++k) s->row_count[o][k] = 0;
  }
}

