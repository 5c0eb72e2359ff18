/* ---- Rows and bounds: layout, checks, and the scan for the most violated one. ---- */

#define QPC_FIRST_BOUND_ID QPC_ROW_SLOTS
#define QPC_FIRST_QUADRATIC_ID (QPC_ROW_SLOTS + 2 * QPC_BLOCKS * QPC_POINTS_PADDED)

static void qpc_neutralise(qpc_copy* s, int slot) {
  for (int c = 0; c < QPC_COMPONENTS; ++c) s->row_normal[c][slot] = 0.0;
  s->row_offset[slot] = -QPC_UNBOUNDED;
}

/* Lists the groups of rows that a scan visits, and makes the slots that fill up the last vector of a group harmless.
   0 if a count is out of range. */
static int qpc_group_rows(qpc_copy* s) {
  int groups = 0;
  for (int o = 0; o < QPC_OUTPUTS; ++o) {
    const int across = qpc_row_stride[o] != 1;
    int used = 0;
    for (int k = 0; k < QPC_HORIZON && qpc_most_rows[o] > 0; ++k) {
      const int count = s->row_count[o][k];
      if (count < 0 || count > qpc_most_rows[o]) return 0;
      const int end = across ? qpc_most_rows[o] : QPC_ROUND_UP(count, QPC_WIDTH);
      const int slot = qpc_first_slot[o] + k * qpc_stage_stride[o];
      for (int i = count; i < end; ++i) qpc_neutralise(s, slot + i * qpc_row_stride[o]);
      if (count > used) used = count;
      if (across || count == 0) continue;
      s->group_slot[groups] = slot;
      s->group_rows[groups] = count;
      s->group_output[groups] = o;
      s->group_index[groups++] = k;
    }
    /* Outputs with few rows lie stage by stage: one group per row number runs across the stages. */
    for (int i = 0; across && i < used; ++i) {
      s->group_slot[groups] = qpc_first_slot[o] + i * qpc_row_stride[o];
      s->group_rows[groups] = QPC_HORIZON;
      s->group_output[groups] = o;
      s->group_index[groups++] = -1;
    }
  }
  s->group_count = groups;
  return 1;
}

/* The scan's best so far, lane by lane: the largest violation and the group or range that has it. Groups are reduced
   by maximum alone, which keeps the chain of dependent instructions short; the row is found again at the end. */
typedef struct {
  qpc_vector violation;
  qpc_mask group;
} qpc_best;

QPC_FUNCTION qpc_vector qpc_maximum(qpc_vector a, qpc_vector b) { return qpc_select((qpc_mask)(a > b), a, b); }

QPC_FUNCTION void qpc_consider(qpc_best* best, qpc_vector violation, int group) {
  const qpc_mask larger = (qpc_mask)(violation > best->violation);
  best->violation = qpc_select(larger, violation, best->violation);
  best->group = (larger & ((qpc_mask){0} + (int64_t)group)) | (~larger & best->group);
}

/* Violations of QPC_WIDTH rows of a group from row i on. */
QPC_FUNCTION qpc_vector qpc_row_violation(const qpc_copy* s, int group, int i) {
  const int output = s->group_output[group], index = s->group_index[group], slot = s->group_slot[group];
  qpc_vector violation = QPC_LOAD(&s->row_offset[slot + i]);
  for (int c = 0; c < QPC_COMPONENTS; ++c) {
    const double* y = &s->output[qpc_output_place[output][c]];
    violation -= QPC_LOAD(&s->row_normal[c][slot + i]) * (index < 0 ? (qpc_vector)QPC_LOAD(y + i) : QPC_BROADCAST(y[index]));
  }
  return violation;
}

/* Lane by lane the largest violation of a group's rows, or 0. */
QPC_FUNCTION qpc_vector qpc_group_violation(const qpc_copy* s, int group) {
  const int output = s->group_output[group], index = s->group_index[group], slot = s->group_slot[group];
  qpc_vector y[QPC_COMPONENTS];
  qpc_vector largest = {0};
  for (int c = 0; c < QPC_COMPONENTS; ++c) {
    y[c] = QPC_BROADCAST(s->output[qpc_output_place[output][c] + (index < 0 ? 0 : index)]);
  }
  for (int i = 0; i < s->group_rows[group]; i += QPC_WIDTH) {
    qpc_vector violation = QPC_LOAD(&s->row_offset[slot + i]);
    for (int c = 0; c < QPC_COMPONENTS; ++c) {
      if (index < 0) y[c] = QPC_LOAD(&s->output[qpc_output_place[output][c] + i]);
      violation -= QPC_LOAD(&s->row_normal[c][slot + i]) * y[c];
    }
    largest = qpc_maximum(violation, largest);
  }
  return largest;
}

QPC_FUNCTION void qpc_scan_bounds(const qpc_copy* s, int first, int count, qpc_best* best) {
  for (int i = first; i < first + count; i += QPC_WIDTH) {
    const qpc_vector y = QPC_LOAD(&s->output[i]);
    const qpc_vector below = QPC_LOAD(&s->lower[i]) - y, above = y - QPC_LOAD(&s->upper[i]);
    qpc_consider(best, qpc_maximum(below, above), -1 - i);
  }
}

/* The worst row of the lane where the scan found it: `group` counts groups from 0 up, or places of bounds from -1
   down. */
static int qpc_found(const qpc_copy* s, int group, int lane, double* violation) {
  if (group < 0) {
    const int place = -1 - group + lane;
    const double below = s->lower[place] - s->output[place], above = s->output[place] - s->upper[place];
    *violation = above > below ? above : below;
    return QPC_FIRST_BOUND_ID + 2 * place + (above > below ? 1 : 0);
  }
  int at = lane;
  *violation = -QPC_UNBOUNDED;
  for (int i = 0; i < s->group_rows[group]; i += QPC_WIDTH) {
    const double candidate = qpc_row_violation(s, group, i)[lane];
    if (candidate <= *violation) continue;
    *violation = candidate;
    at = i + lane;
  }
  return s->group_slot[group] + at;
}

QPC_FUNCTION void qpc_scan_all_bounds(const qpc_copy* s, qpc_best* best) {
  for (int b = 0; b < QPC_BLOCKS; ++b) {
    for (int range = 0; range < QPC_BOUND_RANGES; ++range) {
      qpc_scan_bounds(s, b * QPC_POINTS_PADDED + qpc_bound_range[2 * range], qpc_bound_range[2 * range + 1], best);
    }
  }
}

/* The identity of the row that the scan found, or -1. */
QPC_FUNCTION int qpc_most_violated(const qpc_copy* s, const qpc_best* best, double tolerance, double* violation) {
  int lane = -1;
  *violation = tolerance;
  for (int i = 0; i < QPC_WIDTH; ++i) {
    if (best->violation[i] > *violation) {
      *violation = best->violation[i];
      lane = i;
    }
  }
  return lane < 0 ? -1 : qpc_found(s, (int)best->group[lane], lane, violation);
}

/* Notes which tiles of the outputs belong to points `first` to `last` of a block. */
QPC_FUNCTION void qpc_list_tiles(qpc_copy* s, int first, int last) {
  for (int tile = first / QPC_TILE_POINTS; tile <= last / QPC_TILE_POINTS; ++tile) s->listed_tile[tile] = 1;
}

/* Lists what the scan has found violated: most iterations change the same few rows, and need to look at no others until
   these hold. Pays where there are many. */
#define QPC_CHANGES_BEFORE_LIST 4
static void qpc_list(qpc_copy* s, double tolerance, int bounds) {
  s->listed_count = 0;
  s->listed_bounds = bounds;
  for (int tile = 0; tile < QPC_TILES; ++tile) s->listed_tile[tile] = 0;
  for (int group = 0; group < s->group_count; ++group) {
    int violated = 0;
    for (int i = 0; i < QPC_WIDTH; ++i) violated |= s->group_violation[group][i] > tolerance;
    if (!violated) continue;
    s->listed[s->listed_count++] = group;
    const int index = s->group_index[group];
    for (int c = 0; c < QPC_COMPONENTS; ++c) {
      const int point = qpc_output_place[s->group_output[group]][c] % QPC_POINTS_PADDED;
      qpc_list_tiles(s, index < 0 ? point : point + index, index < 0 ? point + QPC_HORIZON - 1 : point + index);
    }
  }
  for (int range = 0; range < QPC_BOUND_RANGES && bounds; ++range) {
    qpc_list_tiles(s, qpc_bound_range[2 * range], qpc_bound_range[2 * range] + qpc_bound_range[2 * range + 1] - 1);
  }
}

/* The most violated row or bound: its identity, or -1 if none is violated by more than the tolerance. Active rows are
   masked: see qpc_mask_row. */
static int qpc_scan(qpc_copy* s, double tolerance, double* violation) {
  qpc_best best;
  best.violation = QPC_BROADCAST(tolerance);
  best.group = (qpc_mask){0};
  qpc_scan_all_bounds(s, &best);
  int bounds = 0;
  for (int i = 0; i < QPC_WIDTH; ++i) bounds |= best.violation[i] > tolerance;
  for (int group = 0; group < s->group_count; ++group) {
    const qpc_vector largest = qpc_group_violation(s, group);
    QPC_STORE(s->group_violation[group], largest);
    qpc_consider(&best, largest, group);
  }
  const int id = qpc_most_violated(s, &best, tolerance, violation);
  s->listed_count = s->listed_bounds = 0;
  if (id >= 0 && s->iterations >= QPC_CHANGES_BEFORE_LIST) qpc_list(s, tolerance, bounds);
  return id;
}

/* The same among what is listed. */
static int qpc_scan_listed(const qpc_copy* s, double tolerance, double* violation) {
  qpc_best best;
  best.violation = QPC_BROADCAST(tolerance);
  best.group = (qpc_mask){0};
  if (s->listed_bounds) qpc_scan_all_bounds(s, &best);
  for (int i = 0; i < s->listed_count; ++i) qpc_consider(&best, qpc_group_violation(s, s->listed[i]), s->listed[i]);
  return qpc_most_violated(s, &best, tolerance, violation);
}
