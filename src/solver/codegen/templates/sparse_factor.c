/* ---- L D L' of the quasi-definite matrix K, and solving with it. ----
   Neighbouring columns of L with the same pattern form a panel, stored column by column: first the panel's own square,
   then the rows below. A panel is assembled from K, takes the updates of the panels to its left that reach it (each
   a product of dense pieces, of which the tables say where its rows go), and is then factored as a dense matrix. */

/* result[i] -= a[i] * x for i < count */
QPC_FUNCTION void qpc_subtract(double* restrict result, const double* restrict a, double x, int count) {
  for (int i = 0; i < count; ++i) result[i] -= a[i] * x;
}

/* The update of columns [0, columns) of the rows from `first` on of a panel to the left, into s->update. */
QPC_FUNCTION void qpc_panel_product(qpc_solver* s, int panel, int first, int columns, int rows) {
  const int width = qpc_panel_column[panel + 1] - qpc_panel_column[panel];
  const int height = qpc_panel_height[panel];
  const double* restrict l = s->factor + qpc_panel_start[panel] + first;
  const double* restrict pivot = s->pivot + qpc_panel_column[panel];
  for (int q = 0; q < columns; ++q) {
    double* restrict u = s->update + q * rows;
    for (int i = q; i < rows; ++i) u[i] = 0.0;
    int k = 0;
    for (; k + 4 <= width; k += 4) {
      const double* restrict l0 = l + k * height;
      const double* restrict l1 = l0 + height;
      const double* restrict l2 = l1 + height;
      const double* restrict l3 = l2 + height;
      const double x0 = l0[q] * pivot[k], x1 = l1[q] * pivot[k + 1];
      const double x2 = l2[q] * pivot[k + 2], x3 = l3[q] * pivot[k + 3];
      for (int i = q; i < rows; ++i) u[i] += (l0[i] * x0 + l1[i] * x1) + (l2[i] * x2 + l3[i] * x3);
    }
    for (; k < width; ++k) {
      const double* restrict l0 = l + k * height;
      const double x0 = l0[q] * pivot[k];
      for (int i = q; i < rows; ++i) u[i] += l0[i] * x0;
    }
  }
}

/* Takes the updates of all panels that reach this one. */
static void qpc_update_panel(qpc_solver* s, int panel) {
  double* target = s->factor + qpc_panel_start[panel];
  const int height = qpc_panel_height[panel];
  for (int e = qpc_update_start[panel]; e < qpc_update_start[panel + 1]; ++e) {
    const int rows = qpc_update_rows[e], columns = qpc_update_columns[e];
    const qpc_update_index* where = qpc_update_where + qpc_update_first_where[e];
    qpc_panel_product(s, qpc_update_panel_of[e], qpc_update_first_row[e], columns, rows);
    for (int q = 0; q < columns; ++q) {
      double* to = target + where[q] * height;
      const double* u = s->update + q * rows;
      for (int i = q; i < rows; ++i) to[where[i]] -= u[i];
    }
  }
}

/* Dense L D L' of a panel; 0 if a pivot has clearly the wrong sign. */
static int qpc_factor_panel(qpc_solver* s, int panel) {
  const int first = qpc_panel_column[panel], width = qpc_panel_column[panel + 1] - first;
  const int height = qpc_panel_height[panel];
  double* l = s->factor + qpc_panel_start[panel];
  for (int j = 0; j < width; ++j) {
    double* column = l + j * height;
    for (int k = 0; k < j; ++k) {
      qpc_subtract(column + j, l + k * height + j, l[k * height + j] * s->pivot[first + k], height - j);
    }
    const double d = qpc_checked_pivot(s, column[j], qpc_pivot_sign[first + j]);
    if (d == 0.0) return 0;
    s->pivot[first + j] = d;
    s->inverse_pivot[first + j] = 1.0 / d;
    for (int i = j + 1; i < height; ++i) column[i] *= s->inverse_pivot[first + j];
  }
  return 1;
}

static int qpc_factorise(qpc_solver* s) {
  qpc_clear(s->factor, QPC_FACTOR_ROOM);
  for (int k = 0; k < QPC_KKT_ENTRIES; ++k) s->factor[qpc_kkt_place[k]] = s->kkt[k];
  for (int panel = 0; panel < QPC_PANELS; ++panel) {
    qpc_update_panel(s, panel);
    if (!qpc_factor_panel(s, panel)) return 0;
  }
  return 1;
}

/* x = K^-1 x by the factor; s->update holds the rows below a panel. */
static void qpc_substitute(qpc_solver* s, double* restrict x) {
  double* restrict below = s->update;
  for (int panel = 0; panel < QPC_PANELS; ++panel) {
    const int first = qpc_panel_column[panel], width = qpc_panel_column[panel + 1] - first;
    const int height = qpc_panel_height[panel], rows = height - width;
    const qpc_row_index* row = qpc_panel_row + qpc_panel_first_row[panel];
    for (int i = 0; i < rows; ++i) below[i] = 0.0;
    for (int k = 0; k < width; ++k) {
      const double* l = s->factor + qpc_panel_start[panel] + k * height;
      for (int i = k + 1; i < width; ++i) x[first + i] -= l[i] * x[first + k];
      qpc_subtract(below, l + width, x[first + k], rows);
    }
    for (int i = 0; i < rows; ++i) x[row[i]] += below[i];
  }
  for (int i = 0; i < QPC_UNKNOWNS; ++i) x[i] *= s->inverse_pivot[i];
  for (int panel = QPC_PANELS - 1; panel >= 0; --panel) {
    const int first = qpc_panel_column[panel], width = qpc_panel_column[panel + 1] - first;
    const int height = qpc_panel_height[panel], rows = height - width;
    const qpc_row_index* row = qpc_panel_row + qpc_panel_first_row[panel];
    for (int i = 0; i < rows; ++i) below[i] = x[row[i]];
    for (int k = width - 1; k >= 0; --k) {
      const double* l = s->factor + qpc_panel_start[panel] + k * height;
      double sum = x[first + k];
      for (int i = k + 1; i < width; ++i) sum -= l[i] * x[first + i];
      for (int i = 0; i < rows; ++i) sum -= l[width + i] * below[i];
      x[first + k] = sum;
    }
  }
}
