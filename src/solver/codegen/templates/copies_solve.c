/* ---- Several copies: the solver's functions. ---- */

void qpc_function(init)(qpc_solver* s, int copies) {
  uint8_t* bytes = (uint8_t*)s;
  for (size_t i = 0; i < sizeof *s; ++i) bytes[i] = 0;
  s->copy_count = copies;
}

void qpc_function(init_copy)(qpc_copy* s, const qpc_tables* t) {
  qpc_init_copy(s, t);
  for (int o = 0; o < QPC_OUTPUTS; ++o) {
    for (int k = 0; k < QPC_HORIZON; ++k) s->row_count[o][k] = 0;
  }
}

/* Where the couplings' components lie; brings those of unusual size to between 1/2 and 1. 0 if one is out of range or
   not finite. */
static int qpc_place_couplings(qpc_solver* s) {
  if (s->coupling_count < 0 || s->coupling_count > QPC_MAX_COUPLINGS) return 0;
  for (int i = 0; i < s->coupling_count; ++i) {
    const int output = s->coupling_output[i], index = s->coupling_index[i];
    double sum = s->coupling_offset[i] * 0.0, largest = 0.0, scale = 1.0;
    if (output < 0 || output >= QPC_OUTPUTS || index < 0 || index >= QPC_HORIZON) return 0;
    if (s->coupling_copy[0][i] == s->coupling_copy[1][i] || s->coupling_penalty[i] > QPC_PENALTIES) return 0;
    for (int c = 0; c < QPC_ROW_COMPONENTS; ++c) {
      const int copy = s->coupling_copy[c / QPC_COMPONENTS][i];
      const double n = s->coupling_normal[c / QPC_COMPONENTS][c % QPC_COMPONENTS][i];
      if (copy < 0 || copy >= s->copy_count) return 0;
      s->coupling_place[c][i] = copy * QPC_COPY_OUTPUTS + qpc_output_place[output][c % QPC_COMPONENTS] + index;
      sum += n * 0.0;
      largest = qpc_magnitude(n) > largest ? qpc_magnitude(n) : largest;
    }
    if (sum != 0.0) return 0;
    while (largest * scale > 4.0) scale *= 0.5;
    while (largest > 0.0 && largest * scale < 0.125 && scale < 1e150) scale *= 2.0;
    s->coupling_scale[i] = scale;
  }
  return 1;
}

/* Scales the couplings (back, if `undo`). */
static void qpc_scale_couplings(qpc_solver* s, int undo) {
  for (int i = 0; i < s->coupling_count; ++i) {
    if (s->coupling_scale[i] == 1.0) continue;
    const double factor = undo ? 1.0 / s->coupling_scale[i] : s->coupling_scale[i];
    for (int c = 0; c < QPC_ROW_COMPONENTS; ++c) {
      s->coupling_normal[c / QPC_COMPONENTS][c % QPC_COMPONENTS][i] *= factor;
    }
    s->coupling_offset[i] *= factor;
  }
}

/* Looks at the copies' data and finds their optima without rows; the size of their outputs, or < 0 if data are bad. */
static double qpc_prepare(qpc_model t, qpc_solver* s) {
  double size = 0.0;
  s->quadratic_count = 0;
  if (s->copy_count < 1 || s->copy_count > QPC_COPIES) return -1.0;
  for (int k = 0; k < s->copy_count; ++k) {
    qpc_copy* copy = &s->copy[k];
    copy->output = &s->output[k * QPC_COPY_OUTPUTS];
    copy->free_output = &s->free_output[k * QPC_COPY_OUTPUTS];
    copy->scaled = 0;
    if (!qpc_group_rows(copy) || !qpc_quadratics_valid(copy)) return -1.0;
    const int rows = qpc_look_at_rows(copy);
    const double its = qpc_free_response(t[k], copy);
    if (rows == QPC_ROWS_BAD || !qpc_all_finite(copy->free_output, QPC_COPY_OUTPUTS)) return -1.0;
    copy->scaled = rows == QPC_ROWS_UNUSUAL;
    s->quadratic_count += copy->quadratic_count;
    size = its > size ? its : size;
  }
  return qpc_place_couplings(s) ? size : -1.0;
}

static void qpc_scale_all(qpc_solver* s, int undo) {
  for (int k = 0; k < s->copy_count; ++k) {
    if (s->copy[k].scaled) qpc_scale_rows(&s->copy[k], undo);
  }
  qpc_scale_couplings(s, undo);
}

/* Inputs, multipliers and slacks from the working set. */
static void qpc_recover(qpc_model t, qpc_solver* s) {
  for (int k = 0; k < s->copy_count; ++k) {
    for (int b = 0; b < QPC_BLOCKS; ++b) {
      for (int j = 0; j < QPC_RESPONSE_PADDED; ++j) s->copy[k].input[b][j] = s->copy[k].free_input[b][j];
    }
  }
  for (int i = 0; i < s->active_count; ++i) {
    for (int c = 0; c < QPC_PARTS(s->active_id[i]) * QPC_COMPONENTS; ++c) {
      const int copy = s->point[c][i] / QPC_COPY_OUTPUTS, at = s->point[c][i] % QPC_COPY_OUTPUTS;
      const int block = at / QPC_POINTS_PADDED;
      const double* response = t[copy]->response[qpc_class_of_block[block]][at % QPC_POINTS_PADDED];
      const double force = s->lambda[i] * s->normal[c][i];
      for (int j = 0; j < QPC_RESPONSE_PADDED; ++j) s->copy[copy].input[block][j] += response[j] * force;
    }
    s->multiplier[i] = s->lambda[i];
    s->slack[i] = s->flexibility[i] > 0.0 && !QPC_IS_TERM(s->active_id[i])
                      ? (s->lambda[i] - s->row_linear[i]) * s->flexibility[i]
                      : 0.0;
  }
  for (int k = 0; k < s->copy_count; ++k) {
    qpc_order_inputs((const double(*)[QPC_RESPONSE_PADDED])s->copy[k].input, s->copy[k].u);
  }
}

/* Whether the inputs hold what they should, as the models say and not the tables. Asked only where rows nearly
   depended on each other. */
static int qpc_is_proven(qpc_model t, qpc_solver* s, double tolerance) {
  double q[QPC_HORIZON][QPC_BLOCK_STATES][QPC_LANES], r[QPC_HORIZON][QPC_BLOCK_INPUTS][QPC_LANES];
  double z0[QPC_SWEEP_STATES][QPC_LANES], violation;
  qpc_recover(t, s);
  for (int k = 0; k < s->copy_count; ++k) {
    qpc_copy* copy = &s->copy[k];
    if (!qpc_all_finite(&copy->u[0][0], QPC_HORIZON * QPC_INPUTS)) return 0;
    if (!s->delicate) continue;
    qpc_gather(copy, q, r, z0);
    qpc_simulate(t[k], (const double(*)[QPC_LANES])z0, (const double(*)[QPC_RESPONSE_PADDED])copy->input, copy->output);
  }
  if (!s->delicate) return 1;
  return qpc_scan_all(s, 100.0 * tolerance, &violation) < 0 && qpc_residual(s) <= 100.0 * tolerance;
}

/* From the guess, and without it if that led astray. */
static int qpc_run(qpc_model t, qpc_solver* s, double tolerance) {
  const int guesses = s->warm_count;
  int status = QPC_CAP;
  for (int start = 0; start < 2 && status == QPC_CAP; ++start) {
    s->iterations = 0;
    status = qpc_active_set(t, s, tolerance);
    if (status == QPC_SOLVED && !qpc_is_proven(t, s, tolerance)) status = QPC_CAP;
    if (status == QPC_UNFINISHED) qpc_recover(t, s);
    for (int i = 0; i < s->active_count; ++i) qpc_mask_row(s, s->active_id[i], 0, s->offset[i]);
    if (guesses <= 0) break;
    s->warm_count = 0;
  }
  s->warm_count = guesses;
  return status;
}

static int qpc_check_and_run(qpc_model t, qpc_solver* s) {
  const double size = qpc_prepare(t, s);
  if (size < 0.0) return QPC_BAD_DATA;
  qpc_scale_all(s, 0);
  int status = qpc_run(t, s, 1e-11 * (1.0 + size));
  for (int i = 0; i < s->active_count; ++i) {
    s->multiplier[i] *= qpc_scale_of(s, s->active_id[i]);
    s->slack[i] /= qpc_scale_of(s, s->active_id[i]);
  }
  qpc_scale_all(s, 1);
  if (status != QPC_SOLVED && status != QPC_UNFINISHED) return status;
  for (int k = 0; k < s->copy_count; ++k) {
    qpc_copy* copy = &s->copy[k];
    qpc_roll_out(t[k], copy);
    if (!qpc_all_finite(&copy->u[0][0], QPC_HORIZON * QPC_INPUTS) ||
        !qpc_all_finite(&copy->x[0][0], (QPC_HORIZON + 1) * QPC_STATES)) {
      return QPC_BAD_DATA;
    }
  }
  return status;
}

int qpc_function(solve)(qpc_model t, qpc_solver* s) {
  s->iterations = 0;
  s->active_count = 0;
  s->status = qpc_check_and_run(t, s);
  if (s->status == QPC_SOLVED || s->status == QPC_UNFINISHED) return s->status;
  s->active_count = 0;
  for (int k = 0; k < QPC_COPIES; ++k) {
    qpc_clear(&s->copy[k].u[0][0], QPC_HORIZON * QPC_INPUTS);
    qpc_clear(&s->copy[k].x[0][0], (QPC_HORIZON + 1) * QPC_STATES);
  }
  return s->status;
}

#if defined(__clang__)
#pragma clang attribute pop
#endif
