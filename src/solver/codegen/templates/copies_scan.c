/* ---- Several copies: outputs, and the scan of all their rows. ---- */

/* Adds what an entry's force does to a copy's outputs: all of them, or the listed tiles. */
QPC_FUNCTION void qpc_add_force(const qpc_tables* t, qpc_copy* copy, int at, double force, int all) {
  const int block = at / QPC_POINTS_PADDED;
  const double* column = t->gram[qpc_class_of_block[block]][at % QPC_POINTS_PADDED];
  double* y = &copy->output[block * QPC_POINTS_PADDED];
  for (int j = 0; j < QPC_POINTS_PADDED; j += QPC_TILE_POINTS) {
    if (!all && !copy->listed_tile[j / QPC_TILE_POINTS]) continue;
    for (int l = j; l < j + QPC_TILE_POINTS; l += QPC_WIDTH) {
      QPC_STORE(y + l, QPC_LOAD(y + l) + QPC_LOAD(column + l) * force);
    }
  }
}

/* output = free_output + sum over the working set of multiplier times the tables' columns; all of it, or the listed
   tiles. */
static void qpc_update_outputs(qpc_model t, qpc_solver* s, int all) {
  for (int k = 0; k < s->copy_count; ++k) {
    qpc_copy* copy = &s->copy[k];
    for (int b = 0; b < QPC_BLOCKS; ++b) {
      for (int j = 0; j < QPC_POINTS_PADDED; ++j) {
        const int at = b * QPC_POINTS_PADDED + j;
        if (all || copy->listed_tile[j / QPC_TILE_POINTS]) copy->output[at] = copy->free_output[at];
      }
    }
  }
  for (int i = 0; i < s->active_count; ++i) {
    for (int c = 0; c < QPC_PARTS(s->active_id[i]) * QPC_COMPONENTS; ++c) {
      const int copy = s->point[c][i] / QPC_COPY_OUTPUTS;
      const double force = s->lambda[i] * s->normal[c][i];
      if (force != 0.0) qpc_add_force(t[copy], &s->copy[copy], s->point[c][i] % QPC_COPY_OUTPUTS, force, all);
    }
  }
}

QPC_FUNCTION double qpc_coupling_violation(const qpc_solver* s, int i) {
  double violation = s->coupling_offset[i];
  for (int c = 0; c < QPC_ROW_COMPONENTS; ++c) {
    violation -= s->coupling_normal[c / QPC_COMPONENTS][c % QPC_COMPONENTS][i] * s->output[s->coupling_place[c][i]];
  }
  return violation;
}

/* The most violated coupling, if it is by more than `violation`, which then says by how much; -1 otherwise. With `list`:
   takes down all that are violated by more than the tolerance. */
static int qpc_scan_couplings(qpc_solver* s, int list, double tolerance, double* violation) {
  int found = -1;
  if (list) s->listed_couplings = 0;
  for (int i = 0; i < s->coupling_count; ++i) {
    const double candidate = qpc_coupling_violation(s, i);
    if (!(candidate > tolerance)) continue;
    if (list) s->listed_coupling[s->listed_couplings++] = i;
    if (candidate <= *violation) continue;
    *violation = candidate;
    found = QPC_FIRST_COUPLING_ID + i;
  }
  return found;
}

static int qpc_scan_listed_couplings(const qpc_solver* s, double* violation) {
  int found = -1;
  for (int l = 0; l < s->listed_couplings; ++l) {
    const double candidate = qpc_coupling_violation(s, s->listed_coupling[l]);
    if (candidate <= *violation) continue;
    *violation = candidate;
    found = QPC_FIRST_COUPLING_ID + s->listed_coupling[l];
  }
  return found;
}

/* The copies' tiles that the listed couplings need. */
static void qpc_list_coupling_tiles(qpc_solver* s) {
  for (int l = 0; l < s->listed_couplings; ++l) {
    for (int c = 0; c < QPC_ROW_COMPONENTS; ++c) {
      const int place = s->coupling_place[c][s->listed_coupling[l]];
      const int point = place % QPC_COPY_OUTPUTS % QPC_POINTS_PADDED;
      qpc_list_tiles(&s->copy[place / QPC_COPY_OUTPUTS], point, point);
    }
  }
}

/* The most violated of all rows: its identity, or -1 if none is violated by more than the tolerance. */
static int qpc_scan_all(qpc_solver* s, double tolerance, double* violation) {
  const int list = s->iterations >= QPC_CHANGES_BEFORE_LIST;
  int found = -1;
  *violation = tolerance;
  s->listed_count = s->listed_bounds = s->listed_couplings = 0;
  for (int k = 0; k < s->copy_count; ++k) {
    double its;
    s->copy[k].iterations = s->iterations;
    const int id = qpc_scan(&s->copy[k], tolerance, &its);
    if (id < 0) {
      for (int tile = 0; tile < QPC_TILES; ++tile) s->copy[k].listed_tile[tile] = 0;
      continue;
    }
    s->listed_count += s->copy[k].listed_count;
    s->listed_bounds += s->copy[k].listed_bounds;
    if (its <= *violation) continue;
    *violation = its;
    found = QPC_ID(k, id);
  }
  const int coupling = qpc_scan_couplings(s, list, tolerance, violation);
  if (list) qpc_list_coupling_tiles(s);
  return coupling >= 0 ? coupling : found;
}

/* The most violated row, or -1 with all outputs up to date. */
static int qpc_find_violated(qpc_model t, qpc_solver* s, double tolerance, double* violation) {
  if (s->listed_count > 0 || s->listed_bounds || s->listed_couplings > 0) {
    int found = -1;
    *violation = tolerance;
    qpc_update_outputs(t, s, 0);
    for (int k = 0; k < s->copy_count; ++k) {
      double its;
      if (s->copy[k].listed_count == 0 && !s->copy[k].listed_bounds) continue;
      const int id = qpc_scan_listed(&s->copy[k], tolerance, &its);
      if (id < 0 || its <= *violation) continue;
      *violation = its;
      found = QPC_ID(k, id);
    }
    const int coupling = qpc_scan_listed_couplings(s, violation);
    if (coupling >= 0) return coupling;
    if (found >= 0) return found;
  }
  qpc_update_outputs(t, s, 1);
  return qpc_scan_all(s, tolerance, violation);
}
