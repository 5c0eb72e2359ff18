/* ---- One copy: its rows are all there are. ---- */

typedef const qpc_tables* qpc_model;
#define qpc_mask_row qpc_mask_copy_row
#define qpc_load_row qpc_load_copy_row
#define qpc_is_row qpc_is_copy_row
#define qpc_scale_of qpc_copy_scale_of
#define QPC_IS_TERM QPC_IS_QUADRATIC
#define qpc_term_id(s, i) (QPC_FIRST_QUADRATIC_ID + (i))

/* G H^-1 G' between the row and itself. */
static double qpc_gram_self(const qpc_tables* t, const qpc_row* row) {
  double sum = 0.0;
  for (int c = 0; c < QPC_COMPONENTS; ++c) {
    const int block = row->place[c] / QPC_POINTS_PADDED, point = row->place[c] % QPC_POINTS_PADDED;
    const double(*gram)[QPC_POINTS_PADDED] = t->gram[qpc_class_of_block[block]];
    if (QPC_ALIGNED) {
      sum += row->normal[c] * row->normal[c] * gram[point][point];
      continue;
    }
    for (int e = 0; e < QPC_COMPONENTS; ++e) {
      if (row->place[e] / QPC_POINTS_PADDED != block) continue;
      sum += row->normal[c] * row->normal[e] * gram[point][row->place[e] % QPC_POINTS_PADDED];
    }
  }
  return sum;
}

/* column_i = G H^-1 G' between the row and each of the working set's. */
static void qpc_gram_column(const qpc_tables* t, qpc_solver* s, const qpc_row* row) {
  const int n = s->active_count;
#if QPC_ALIGNED
  const int point = row->place[0];
  for (int i = 0; i < n; ++i) {
    double sum = 0.0;
    for (int c = 0; c < QPC_COMPONENTS; ++c) {
      sum += row->normal[c] * s->normal[c][i] * t->gram[qpc_class_of_block[c]][point][s->point[0][i]];
    }
    s->column[i] = sum;
  }
#else
  for (int i = 0; i < n; ++i) {
    double sum = 0.0;
    for (int c = 0; c < QPC_COMPONENTS; ++c) {
      const int block = row->place[c] / QPC_POINTS_PADDED, point = row->place[c] % QPC_POINTS_PADDED;
      for (int e = 0; e < QPC_COMPONENTS; ++e) {
        if (s->point[e][i] / QPC_POINTS_PADDED != block) continue;
        sum += row->normal[c] * s->normal[e][i] *
               t->gram[qpc_class_of_block[block]][point][s->point[e][i] % QPC_POINTS_PADDED];
      }
    }
    s->column[i] = sum;
  }
#endif
  for (int i = n; i < QPC_ROUND_UP(n, QPC_WIDTH); ++i) s->column[i] = 0.0;
}

/* output = free_output + sum over the working set of multiplier times the tables' columns; all of it, or the listed
   tiles. */
static void qpc_update_outputs(const qpc_tables* t, qpc_solver* s, int all) {
  const int n = s->active_count;
#if QPC_ALIGNED
  for (int j = 0; j < QPC_POINTS_PADDED; j += QPC_TILE_POINTS) {
    if (!all && !s->listed_tile[j / QPC_TILE_POINTS]) continue;
    qpc_vector sum[QPC_BLOCKS][QPC_TILE];
    for (int b = 0; b < QPC_BLOCKS; ++b) {
      for (int l = 0; l < QPC_TILE; ++l) {
        sum[b][l] = QPC_LOAD(&s->free_output[b * QPC_POINTS_PADDED + j + l * QPC_WIDTH]);
      }
    }
    for (int i = 0; i < n; ++i) {
      const double lambda = s->lambda[i];
      for (int b = 0; b < QPC_BLOCKS; ++b) {
        const double* column = &t->gram[qpc_class_of_block[b]][s->point[0][i]][j];
        const double force = lambda * s->normal[b][i];
        for (int l = 0; l < QPC_TILE; ++l) sum[b][l] += QPC_LOAD(column + l * QPC_WIDTH) * force;
      }
    }
    for (int b = 0; b < QPC_BLOCKS; ++b) {
      for (int l = 0; l < QPC_TILE; ++l) QPC_STORE(&s->output[b * QPC_POINTS_PADDED + j + l * QPC_WIDTH], sum[b][l]);
    }
  }
#else
  (void)all;
  for (int j = 0; j < QPC_BLOCKS * QPC_POINTS_PADDED; ++j) s->output[j] = s->free_output[j];
  for (int i = 0; i < n; ++i) {
    for (int c = 0; c < QPC_COMPONENTS; ++c) {
      const int block = s->point[c][i] / QPC_POINTS_PADDED, point = s->point[c][i] % QPC_POINTS_PADDED;
      const double* column = t->gram[qpc_class_of_block[block]][point];
      const double force = s->lambda[i] * s->normal[c][i];
      for (int j = 0; j < QPC_POINTS_PADDED; j += QPC_WIDTH) {
        double* y = &s->output[block * QPC_POINTS_PADDED + j];
        QPC_STORE(y, QPC_LOAD(y) + QPC_LOAD(column + j) * force);
      }
    }
  }
#endif
}

/* The most violated row, or -1 with all outputs up to date. */
static int qpc_find_violated(const qpc_tables* t, qpc_solver* s, double tolerance, double* violation) {
  if (s->listed_count > 0 || s->listed_bounds) {
    qpc_update_outputs(t, s, 0);
    const int id = qpc_scan_listed(s, tolerance, violation);
    if (id >= 0) return id;
  }
  qpc_update_outputs(t, s, 1);
  return qpc_scan(s, tolerance, violation);
}
