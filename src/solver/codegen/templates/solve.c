/* ---- The solver's functions. ---- */

void qpc_function(init)(qpc_solver* s, const qpc_tables* t) {
  uint8_t* bytes = (uint8_t*)s;
  for (size_t i = 0; i < sizeof *s; ++i) bytes[i] = 0;
  s->tolerance = 1e-8;
  qpc_init_copy(s, t);
}

void qpc_function(set_rows)(qpc_solver* s, int output, int index, int count, const float* normals,
                            const float* offsets) {
  const int slot = qpc_first_slot[output] + index * qpc_stage_stride[output];
  s->row_count[output][index] = count;
  if (count < 0 || count > qpc_most_rows[output]) return; /* solve reports it */
  if (qpc_row_stride[output] == 1) {
    for (int i = 0; i < count; ++i) {
      for (int c = 0; c < QPC_COMPONENTS; ++c) s->row_normal[c][slot + i] = normals[QPC_COMPONENTS * i + c];
    }
    for (int i = 0; i < count; ++i) s->row_offset[slot + i] = offsets[i];
    return;
  }
  for (int i = 0; i < count; ++i) {
    const int at = slot + i * qpc_row_stride[output];
    for (int c = 0; c < QPC_COMPONENTS; ++c) s->row_normal[c][at] = normals[QPC_COMPONENTS * i + c];
    s->row_offset[at] = offsets[i];
  }
}

/* Inputs, multipliers and slacks from the working set. */
static void qpc_recover(const qpc_tables* t, qpc_solver* s) {
  for (int b = 0; b < QPC_BLOCKS; ++b) {
    for (int j = 0; j < QPC_RESPONSE_PADDED; j += QPC_WIDTH) {
      qpc_vector sum = QPC_LOAD(&s->free_input[b][j]);
      for (int i = 0; i < s->active_count; ++i) {
        for (int c = 0; c < QPC_COMPONENTS; ++c) {
          if (QPC_ALIGNED ? c != b : s->point[c][i] / QPC_POINTS_PADDED != b) continue;
          const double force = s->lambda[i] * s->normal[c][i];
          sum += QPC_LOAD(&t->response[qpc_class_of_block[b]][s->point[c][i] % QPC_POINTS_PADDED][j]) * force;
        }
      }
      QPC_STORE(&s->input[b][j], sum);
    }
  }
  for (int i = 0; i < s->active_count; ++i) {
    s->multiplier[i] = s->lambda[i];
    s->slack[i] = s->flexibility[i] > 0.0 && !QPC_IS_QUADRATIC(s->active_id[i])
                      ? (s->lambda[i] - s->row_linear[i]) * s->flexibility[i]
                      : 0.0;
  }
  qpc_order_inputs((const double(*)[QPC_RESPONSE_PADDED])s->input, s->u);
}

/* Whether the inputs hold what they should, as the model says and not the tables. Rows that nearly depend on each other
   can leave multipliers with so few digits that these do not. Asked only where there were such. */
static int qpc_is_proven(const qpc_tables* t, qpc_solver* s, double tolerance) {
  double q[QPC_HORIZON][QPC_BLOCK_STATES][QPC_LANES], r[QPC_HORIZON][QPC_BLOCK_INPUTS][QPC_LANES];
  double z0[QPC_SWEEP_STATES][QPC_LANES], violation;
  qpc_recover(t, s);
  if (!qpc_all_finite(&s->u[0][0], QPC_HORIZON * QPC_INPUTS)) return 0;
  if (!s->delicate) return 1;
  qpc_gather(s, q, r, z0);
  qpc_simulate(t, (const double(*)[QPC_LANES])z0, (const double(*)[QPC_RESPONSE_PADDED])s->input, s->output);
  return qpc_scan(s, 100.0 * tolerance, &violation) < 0 && qpc_residual(s) <= 100.0 * tolerance;
}

static void qpc_clear_result(qpc_solver* s) {
  qpc_clear(&s->u[0][0], QPC_HORIZON * QPC_INPUTS);
  qpc_clear(&s->x[0][0], (QPC_HORIZON + 1) * QPC_STATES);
  s->active_count = 0;
}

/* The method that was asked for, and the other one where that meets its cap. Where neither gets as far as asked, the
   interior-point method may stop earlier: `gap` says where. */
static int qpc_run(const qpc_tables* t, qpc_solver* s, double tolerance) {
  int status = QPC_CAP;
  for (int attempt = 0; attempt < 2 && status == QPC_CAP; ++attempt) {
    const int active_set = (s->wanted_method == QPC_ACTIVE_SET) == (attempt == 0);
    s->method = active_set ? QPC_ACTIVE_SET : QPC_INTERIOR_POINT;
    s->iterations = 0;
    s->gap = 0.0;
    if (!active_set) {
      status = qpc_interior_point(t, s, tolerance);
      continue;
    }
    const int guesses = s->warm_count;
    for (int start = 0; start < 2 && status == QPC_CAP; ++start) {
      s->iterations = 0;
      status = qpc_active_set(t, s, tolerance);
      if (status == QPC_SOLVED && !qpc_is_proven(t, s, tolerance)) status = QPC_CAP;
      if (status == QPC_UNFINISHED) qpc_recover(t, s);
      for (int i = 0; i < s->active_count; ++i) qpc_mask_row(s, s->active_id[i], 0, s->offset[i]);
      if (guesses <= 0) break;
      s->warm_count = 0; /* a guess that led astray is not worth the other method */
    }
    s->warm_count = guesses;
  }
  const double asked = s->tolerance;
  for (int relaxed = 0; relaxed < 3 && status == QPC_CAP; ++relaxed) {
    s->method = QPC_INTERIOR_POINT;
    s->tolerance *= 1e3;
    status = qpc_interior_point(t, s, tolerance);
  }
  s->tolerance = asked;
  return status;
}

static int qpc_check_and_run(const qpc_tables* t, qpc_solver* s) {
  if (!qpc_group_rows(s) || !qpc_quadratics_valid(s)) return QPC_BAD_DATA;
  const int rows = qpc_look_at_rows(s);
  const double size = qpc_free_response(t, s);
  if (rows == QPC_ROWS_BAD || !qpc_all_finite(s->free_output, QPC_BLOCKS * QPC_POINTS_PADDED)) return QPC_BAD_DATA;
  s->scaled = rows == QPC_ROWS_UNUSUAL;
  if (s->scaled) qpc_scale_rows(s, 0);
  const int status = qpc_run(t, s, 1e-11 * (1.0 + size));
  if (s->scaled) {
    for (int i = 0; i < s->active_count; ++i) {
      s->multiplier[i] *= qpc_scale_of(s, s->active_id[i]);
      s->slack[i] /= qpc_scale_of(s, s->active_id[i]);
    }
    qpc_scale_rows(s, 1);
  }
  if (status != QPC_SOLVED && status != QPC_UNFINISHED) return status;
  qpc_roll_out(t, s);
  return qpc_all_finite(&s->u[0][0], QPC_HORIZON * QPC_INPUTS) &&
                 qpc_all_finite(&s->x[0][0], (QPC_HORIZON + 1) * QPC_STATES)
             ? status
             : QPC_BAD_DATA;
}

int qpc_function(solve)(const qpc_tables* t, qpc_solver* s) {
  s->iterations = 0;
  s->method = QPC_ACTIVE_SET;
  s->active_count = 0;
  s->status = qpc_check_and_run(t, s);
  if (s->status != QPC_SOLVED && s->status != QPC_UNFINISHED) qpc_clear_result(s);
  return s->status;
}

#if defined(__clang__)
#pragma clang attribute pop
#endif
