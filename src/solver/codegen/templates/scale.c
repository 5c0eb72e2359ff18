/* ---- Rows of unusual size. ----
   The scan compares rows by their violation, and one tolerance holds for all: that asks for normals of length about 1.
   Rows far from it are scaled by powers of two for the time of a solve, which loses no digit, and their penalties,
   multipliers and slacks with them. Usual rows cost one look. */

enum { QPC_ROWS_USUAL, QPC_ROWS_UNUSUAL, QPC_ROWS_BAD };

/* Looks at every row in use: not finite? a squared length outside of 1/16 to 16, and not 0? */
static int qpc_look_at_rows(const qpc_copy* s) {
  qpc_vector finite = {0};
  qpc_mask unusual = {0};
  for (int group = 0; group < s->group_count; ++group) {
    for (int i = 0; i < s->group_rows[group]; i += QPC_WIDTH) {
      const int slot = s->group_slot[group] + i;
      qpc_vector square = {0};
      for (int c = 0; c < QPC_COMPONENTS; ++c) {
        square += QPC_LOAD(&s->row_normal[c][slot]) * QPC_LOAD(&s->row_normal[c][slot]);
      }
      finite += (square + QPC_LOAD(&s->row_offset[slot])) * 0.0;
      unusual |= (qpc_mask)(square > 16.0) | ((qpc_mask)(square < 0.0625) & (qpc_mask)(square > 0.0));
    }
  }
  int found = QPC_ROWS_USUAL;
  for (int i = 0; i < QPC_WIDTH; ++i) {
    if (finite[i] != 0.0) return QPC_ROWS_BAD;
    if (unusual[i]) found = QPC_ROWS_UNUSUAL;
  }
  return found;
}

/* The power of two that brings the row's largest component to between 1/2 and 1. */
static double qpc_row_scale(const qpc_copy* s, int slot) {
  double largest = 0.0, scale = 1.0;
  for (int c = 0; c < QPC_COMPONENTS; ++c) {
    const double size = s->row_normal[c][slot] < 0.0 ? -s->row_normal[c][slot] : s->row_normal[c][slot];
    largest = size > largest ? size : largest;
  }
  if (largest == 0.0) return 1.0;
  while (largest * scale > 1.0) scale *= 0.5;
  while (largest * scale < 0.5 && scale < 1e150) scale *= 2.0;
  return scale;
}

/* Scales all rows (back, if `undo`). */
static void qpc_scale_rows(qpc_copy* s, int undo) {
  for (int group = 0; group < s->group_count; ++group) {
    for (int i = 0; i < QPC_ROUND_UP(s->group_rows[group], QPC_WIDTH); ++i) {
      const int slot = s->group_slot[group] + i;
      if (!undo) s->row_scale[slot] = qpc_row_scale(s, slot);
      if (s->row_scale[slot] == 1.0) continue;
      const double factor = undo ? 1.0 / s->row_scale[slot] : s->row_scale[slot];
      for (int c = 0; c < QPC_COMPONENTS; ++c) s->row_normal[c][slot] *= factor;
      s->row_offset[slot] *= factor;
    }
  }
}

/* Factor between the scaled and the caller's row: normal, offset and slack are that much larger, the multiplier
   smaller. */
static double qpc_copy_scale_of(const qpc_copy* s, int id) {
  return s->scaled && id < QPC_ROW_SLOTS ? s->row_scale[id] : 1.0;
}
