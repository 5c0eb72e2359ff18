/* ---- Several copies: rows of one of them, and couplings of two. ----
   The Hessian is block diagonal over the copies: G H^-1 G' of two rows is the sum of the table entries of the copies
   that both touch. A row has two parts, one for each copy; the second one of a row of one copy has no force. */

typedef const qpc_tables* const* qpc_model;

#define QPC_FIRST_COUPLING_ID (QPC_COPIES * QPC_COPY_IDS)
#define QPC_IS_TERM(id) ((id) < QPC_FIRST_COUPLING_ID && QPC_IS_QUADRATIC((id) % QPC_COPY_IDS))
#define QPC_PARTS(id) ((id) < QPC_FIRST_COUPLING_ID ? 1 : 2)

static void qpc_mask_row(qpc_solver* s, int id, int masked, double offset) {
  if (id < QPC_FIRST_COUPLING_ID) {
    qpc_mask_copy_row(&s->copy[id / QPC_COPY_IDS], id % QPC_COPY_IDS, masked, offset);
  } else {
    s->coupling_offset[id - QPC_FIRST_COUPLING_ID] = masked ? -QPC_UNBOUNDED : offset;
  }
}

static int qpc_load_coupling(qpc_model t, const qpc_solver* s, int i, qpc_row* row) {
  const int penalty = s->coupling_penalty[i];
  row->output = s->coupling_output[i];
  row->index = s->coupling_index[i];
  for (int c = 0; c < QPC_ROW_COMPONENTS; ++c) {
    row->place[c] = s->coupling_place[c][i];
    row->normal[c] = s->coupling_normal[c / QPC_COMPONENTS][c % QPC_COMPONENTS][i];
  }
  row->offset = s->coupling_offset[i];
  if (penalty > QPC_PENALTIES) return 0;
  row->linear = t[0]->penalty_linear[penalty];
  row->compliance = t[0]->compliance[penalty];
  if (penalty > 0) {
    row->linear /= s->coupling_scale[i];
    row->compliance *= s->coupling_scale[i] * s->coupling_scale[i];
  }
  return 1;
}

static int qpc_load_row(qpc_model t, const qpc_solver* s, int id, qpc_row* row) {
  if (id >= QPC_FIRST_COUPLING_ID) {
    row->id = id;
    return qpc_load_coupling(t, s, id - QPC_FIRST_COUPLING_ID, row);
  }
  const int copy = id / QPC_COPY_IDS;
  const int loaded = qpc_load_copy_row(t[copy], &s->copy[copy], id % QPC_COPY_IDS, row);
  row->id = id;
  for (int c = 0; c < QPC_COMPONENTS; ++c) {
    row->place[c] += copy * QPC_COPY_OUTPUTS;
    row->place[c + QPC_COMPONENTS] = row->place[c];
    row->normal[c + QPC_COMPONENTS] = 0.0;
  }
  return loaded;
}

static int qpc_is_row(const qpc_solver* s, int id) {
  if (id < 0) return 0;
  if (id >= QPC_FIRST_COUPLING_ID) {
    const int i = id - QPC_FIRST_COUPLING_ID;
    return i < s->coupling_count && s->coupling_offset[i] > -QPC_UNBOUNDED;
  }
  return id / QPC_COPY_IDS < s->copy_count && qpc_is_copy_row(&s->copy[id / QPC_COPY_IDS], id % QPC_COPY_IDS);
}

static double qpc_scale_of(const qpc_solver* s, int id) {
  if (id >= QPC_FIRST_COUPLING_ID) return s->coupling_scale[id - QPC_FIRST_COUPLING_ID];
  return qpc_copy_scale_of(&s->copy[id / QPC_COPY_IDS], id % QPC_COPY_IDS);
}

/* The identity of quadratic term i of all. */
static int qpc_term_id(const qpc_solver* s, int i) {
  int copy = 0;
  for (; i >= s->copy[copy].quadratic_count; ++copy) i -= s->copy[copy].quadratic_count;
  return QPC_ID(copy, QPC_FIRST_QUADRATIC_ID + i);
}

/* G H^-1 G' between a part of a row and part `part` of the working set's entry i, if both are of the same copy. */
QPC_FUNCTION double qpc_gram_part(qpc_model t, const qpc_solver* s, const int* place, const double* normal, int i,
                                  int part) {
  const int first = part * QPC_COMPONENTS, copy = place[0] / QPC_COPY_OUTPUTS;
  double sum = 0.0;
  if (s->point[first][i] / QPC_COPY_OUTPUTS != copy) return 0.0;
  for (int c = 0; c < QPC_COMPONENTS; ++c) {
    const int at = place[c] % QPC_COPY_OUTPUTS, block = at / QPC_POINTS_PADDED;
    const double* gram = t[copy]->gram[qpc_class_of_block[block]][at % QPC_POINTS_PADDED];
    for (int e = QPC_ALIGNED ? c : 0; e < (QPC_ALIGNED ? c + 1 : QPC_COMPONENTS); ++e) {
      const int other = s->point[first + e][i] % QPC_COPY_OUTPUTS;
      if (!QPC_ALIGNED && other / QPC_POINTS_PADDED != block) continue;
      sum += normal[c] * s->normal[first + e][i] * gram[other % QPC_POINTS_PADDED];
    }
  }
  return sum;
}

/* G H^-1 G' between the row and itself: couplings are of two different copies. */
static double qpc_gram_self(qpc_model t, const qpc_row* row) {
  double sum = 0.0;
  for (int c = 0; c < QPC_ROW_COMPONENTS; ++c) {
    const int first = c / QPC_COMPONENTS * QPC_COMPONENTS, copy = row->place[c] / QPC_COPY_OUTPUTS;
    const int at = row->place[c] % QPC_COPY_OUTPUTS, block = at / QPC_POINTS_PADDED;
    const double* gram = t[copy]->gram[qpc_class_of_block[block]][at % QPC_POINTS_PADDED];
    for (int e = first; e < first + QPC_COMPONENTS; ++e) {
      const int other = row->place[e] % QPC_COPY_OUTPUTS;
      if (other / QPC_POINTS_PADDED != block) continue;
      sum += row->normal[c] * row->normal[e] * gram[other % QPC_POINTS_PADDED];
    }
  }
  return sum;
}

/* column_i = G H^-1 G' between the row and each of the working set's. */
static void qpc_gram_column(qpc_model t, qpc_solver* s, const qpc_row* row) {
  const int n = s->active_count, parts = QPC_PARTS(row->id);
  for (int i = 0; i < n; ++i) {
    const int others = QPC_PARTS(s->active_id[i]);
    double sum = 0.0;
    for (int part = 0; part < parts; ++part) {
      for (int other = 0; other < others; ++other) {
        sum += qpc_gram_part(t, s, &row->place[part * QPC_COMPONENTS], &row->normal[part * QPC_COMPONENTS], i, other);
      }
    }
    s->column[i] = sum;
  }
  for (int i = n; i < QPC_ROUND_UP(n, QPC_WIDTH); ++i) s->column[i] = 0.0;
}
