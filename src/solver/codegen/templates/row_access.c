/* ---- Rows of one copy, by their identity: slots first, then bounds, then quadratic terms. ---- */

typedef struct {
  int id;
  int output, index;         /* of the stage */
  int place[QPC_ROW_COMPONENTS]; /* flat, in qpc_solver.output */
  double normal[QPC_ROW_COMPONENTS];
  double offset;
  double linear, compliance; /* hard: QPC_UNBOUNDED, 0 */
} qpc_row;

#define QPC_IS_QUADRATIC(id) ((id) >= QPC_FIRST_QUADRATIC_ID)

/* Takes a row or bound out of the scan while it is in the working set, or puts it back. */
static void qpc_mask_copy_row(qpc_copy* s, int id, int masked, double offset) {
  if (id < QPC_FIRST_BOUND_ID) {
    s->row_offset[id] = masked ? -QPC_UNBOUNDED : offset;
  } else if (!QPC_IS_QUADRATIC(id)) {
    const int place = (id - QPC_FIRST_BOUND_ID) / 2;
    if ((id - QPC_FIRST_BOUND_ID) % 2 != 0) {
      s->upper[place] = masked ? QPC_UNBOUNDED : -offset;
    } else {
      s->lower[place] = masked ? -QPC_UNBOUNDED : offset;
    }
  }
}

/* The three below return 0 if the row's penalty does not exist. */
static int qpc_load_slot(const qpc_tables* t, const qpc_copy* s, int id, qpc_row* row) {
  int o = 0;
  while (o + 1 < QPC_OUTPUTS && id >= qpc_first_slot[o + 1]) ++o;
  const int within = id - qpc_first_slot[o];
  const int index = qpc_row_stride[o] == 1 ? within / qpc_stage_stride[o] : within % qpc_row_stride[o];
  const int penalty = s->row_penalty[id];
  row->output = o;
  row->index = index;
  for (int c = 0; c < QPC_COMPONENTS; ++c) {
    row->place[c] = qpc_output_place[o][c] + index;
    row->normal[c] = s->row_normal[c][id];
  }
  row->offset = s->row_offset[id];
  if (penalty > QPC_PENALTIES) return 0;
  row->linear = t->penalty_linear[penalty];
  row->compliance = t->compliance[penalty];
  if (s->scaled && penalty > 0) {
    row->linear /= s->row_scale[id];
    row->compliance *= s->row_scale[id] * s->row_scale[id];
  }
  return 1;
}

static int qpc_load_bound(const qpc_tables* t, const qpc_copy* s, int id, qpc_row* row) {
  const int is_upper = (id - QPC_FIRST_BOUND_ID) % 2;
  const int place = (id - QPC_FIRST_BOUND_ID) / 2;
  const int block = place / QPC_POINTS_PADDED, channel = place % QPC_POINTS_PADDED / QPC_HORIZON;
  const int penalty = qpc_bound_penalty[block][channel];
  row->output = qpc_channel_output[block][channel];
  row->index = place % QPC_POINTS_PADDED % QPC_HORIZON;
  for (int c = 0; c < QPC_COMPONENTS; ++c) {
    row->place[c] = qpc_output_place[row->output][c] + row->index;
    row->normal[c] = 0.0;
  }
  row->normal[qpc_channel_component[block][channel]] = is_upper ? -1.0 : 1.0;
  row->offset = is_upper ? -s->upper[place] : s->lower[place];
  row->linear = t->penalty_linear[penalty];
  row->compliance = t->compliance[penalty];
  return 1;
}

static int qpc_load_copy_row(const qpc_tables* t, const qpc_copy* s, int id, qpc_row* row) {
  row->id = id;
  if (id < QPC_FIRST_BOUND_ID) return qpc_load_slot(t, s, id, row);
  if (!QPC_IS_QUADRATIC(id)) return qpc_load_bound(t, s, id, row);
  const int i = id - QPC_FIRST_QUADRATIC_ID;
  row->output = s->quadratic_output[i];
  row->index = s->quadratic_index[i];
  for (int c = 0; c < QPC_COMPONENTS; ++c) {
    row->place[c] = qpc_output_place[row->output][c] + row->index;
    row->normal[c] = s->quadratic_normal[i][c];
  }
  row->offset = s->quadratic_offset[i];
  row->linear = 0.0;
  row->compliance = 1.0 / s->quadratic_weight[i];
  return 1;
}

static int qpc_is_copy_row(const qpc_copy* s, int id) {
  if (id < 0 || id >= QPC_FIRST_QUADRATIC_ID) return 0;
  if (id >= QPC_FIRST_BOUND_ID) {
    const int place = (id - QPC_FIRST_BOUND_ID) / 2;
    const double bound = (id - QPC_FIRST_BOUND_ID) % 2 != 0 ? s->upper[place] : -s->lower[place];
    return bound < QPC_UNBOUNDED;
  }
  return s->row_offset[id] > -QPC_UNBOUNDED;
}
