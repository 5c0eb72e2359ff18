/* ---- Interior point: primal-dual, predictor and corrector. ----
   Every row has room = n . y + slack - offset >= 0 with its multiplier lambda, and, if it is soft, slack >= 0 with the
   multiplier reserve = linear + quadratic slack - lambda. Eliminating all four from Newton's equations leaves a weight
   n n' / (room / lambda + slack / (quadratic slack + reserve)) on the row's output and a force along n: the problem
   without rows, with other costs, which the Riccati recursion solves. Outputs, not steps, are solved for. */

#define QPC_IP_MAX_STEPS 60

typedef struct {
  qpc_vector numerator[4], denominator[4]; /* per lane, the largest of -step / value so far */
  qpc_vector linear, quadratic;            /* the complementarity's change with the step: linear a + quadratic a^2 */
} qpc_ratio;

QPC_FUNCTION double qpc_sum(qpc_vector v) {
  double sum = 0.0;
  for (int i = 0; i < QPC_WIDTH; ++i) sum += v[i];
  return sum;
}

QPC_FUNCTION qpc_vector qpc_only(qpc_mask mask, qpc_vector v) { return (qpc_vector)(mask & (qpc_mask)v); }

/* What the complementarities are steered to: centre (0: affine), with the second-order terms or without. */
typedef struct {
  double centre;
  int corrected;
} qpc_aim;

/* The row's part of the force along its normal; also kept as the target of its multiplier. */
QPC_FUNCTION qpc_vector qpc_ip_pull(qpc_solver* s, int e, qpc_vector offset, qpc_aim aim, qpc_vector* weight) {
  const qpc_vector lambda = QPC_LOAD(&s->ip_lambda[e]), slack = QPC_LOAD(&s->ip_slack[e]);
  const qpc_vector inverse_room = QPC_LOAD(&s->ip_inverse_room[e]);
  const qpc_vector inverse_reserve = QPC_LOAD(&s->ip_inverse_reserve[e]);
  qpc_vector first = QPC_BROADCAST(aim.centre), second = first;
  if (aim.corrected) {
    first -= QPC_LOAD(&s->ip_product[0][e]);
    second -= QPC_LOAD(&s->ip_product[1][e]);
  }
  second = qpc_only((qpc_mask)(slack > 0.0), second);
  *weight = lambda * inverse_room;
  const qpc_vector pull = lambda + inverse_room * (lambda * (offset - slack) + first) -
                          *weight * inverse_reserve * (second - QPC_LOAD(&s->ip_reserve[e]) * slack);
  QPC_STORE(&s->ip_target[e], pull);
  return pull;
}

/* Takes the last step, and refreshes what depends on the variables. */
QPC_FUNCTION void qpc_ip_advance(qpc_solver* s, int e, double step) {
  const qpc_vector lambda = QPC_LOAD(&s->ip_lambda[e]) + QPC_LOAD(&s->ip_step[0][e]) * step;
  const qpc_vector room = QPC_LOAD(&s->ip_room[e]) + QPC_LOAD(&s->ip_step[1][e]) * step;
  const qpc_vector slack = QPC_LOAD(&s->ip_slack[e]) + QPC_LOAD(&s->ip_step[2][e]) * step;
  const qpc_vector reserve = QPC_LOAD(&s->ip_reserve[e]) + QPC_LOAD(&s->ip_step[3][e]) * step;
  const qpc_vector inverse_reserve = 1.0 / (QPC_LOAD(&s->ip_quadratic[e]) * slack + reserve);
  QPC_STORE(&s->ip_lambda[e], lambda);
  QPC_STORE(&s->ip_room[e], room);
  QPC_STORE(&s->ip_slack[e], slack);
  QPC_STORE(&s->ip_reserve[e], reserve);
  QPC_STORE(&s->ip_inverse_reserve[e], inverse_reserve);
  QPC_STORE(&s->ip_inverse_room[e], 1.0 / (room + lambda * slack * inverse_reserve));
}

QPC_FUNCTION void qpc_ip_limit(qpc_ratio* ratio, int i, qpc_vector value, qpc_vector step) {
  const qpc_mask larger = (qpc_mask)(-step * ratio->denominator[i] > ratio->numerator[i] * value);
  ratio->numerator[i] = qpc_select(larger, -step, ratio->numerator[i]);
  ratio->denominator[i] = qpc_select(larger, value, ratio->denominator[i]);
}

/* Directions of a row's four variables, given n . y of the new outputs. */
QPC_FUNCTION void qpc_ip_direction(qpc_solver* s, int e, qpc_vector row_value, qpc_vector offset, qpc_aim aim,
                                   qpc_ratio* ratio) {
  const qpc_vector lambda = QPC_LOAD(&s->ip_lambda[e]), room = QPC_LOAD(&s->ip_room[e]);
  const qpc_vector slack = QPC_LOAD(&s->ip_slack[e]), reserve = QPC_LOAD(&s->ip_reserve[e]);
  const qpc_mask soft = (qpc_mask)(slack > 0.0), live = (qpc_mask)(offset > -0.5 * QPC_UNBOUNDED);
  qpc_vector second = QPC_BROADCAST(aim.centre);
  if (aim.corrected) second -= QPC_LOAD(&s->ip_product[1][e]);
  const qpc_vector weight = lambda * QPC_LOAD(&s->ip_inverse_room[e]);
  const qpc_vector d_lambda = qpc_only(live, QPC_LOAD(&s->ip_target[e]) - lambda - weight * row_value);
  const qpc_vector d_slack =
      (slack * d_lambda + qpc_only(soft, second) - reserve * slack) * QPC_LOAD(&s->ip_inverse_reserve[e]);
  const qpc_vector d_room = qpc_only(live, row_value - offset + slack + d_slack - room);
  const qpc_vector d_reserve = qpc_only(soft, QPC_LOAD(&s->ip_quadratic[e]) * d_slack - d_lambda);
  qpc_ip_limit(ratio, 0, lambda, d_lambda);
  qpc_ip_limit(ratio, 1, room, d_room);
  qpc_ip_limit(ratio, 2, slack, d_slack);
  qpc_ip_limit(ratio, 3, reserve, d_reserve);
  const qpc_vector first_product = d_lambda * d_room, second_product = d_slack * d_reserve;
  ratio->linear += lambda * d_room + room * d_lambda + slack * d_reserve + reserve * d_slack;
  ratio->quadratic += first_product + second_product;
  if (aim.corrected) {
    QPC_STORE(&s->ip_step[0][e], d_lambda);
    QPC_STORE(&s->ip_step[1][e], d_room);
    QPC_STORE(&s->ip_step[2][e], d_slack);
    QPC_STORE(&s->ip_step[3][e], d_reserve);
  } else {
    QPC_STORE(&s->ip_product[0][e], first_product);
    QPC_STORE(&s->ip_product[1][e], second_product);
  }
}

/* Weights and forces of one group of rows. */
QPC_FUNCTION void qpc_ip_group_forces(qpc_solver* s, int group, double step, qpc_aim aim) {
  const int o = s->group_output[group], index = s->group_index[group], slot = s->group_slot[group];
  qpc_vector weights[QPC_WEIGHTS], forces[QPC_COMPONENTS];
  for (int i = 0; i < QPC_WEIGHTS; ++i) weights[i] = (qpc_vector){0};
  for (int c = 0; c < QPC_COMPONENTS; ++c) forces[c] = (qpc_vector){0};
  for (int i = 0; i < s->group_rows[group]; i += QPC_WIDTH) {
    qpc_vector weight, normal[QPC_COMPONENTS];
    if (!aim.corrected) qpc_ip_advance(s, slot + i, step);
    const qpc_vector pull = qpc_ip_pull(s, slot + i, QPC_LOAD(&s->row_offset[slot + i]), aim, &weight);
    for (int c = 0; c < QPC_COMPONENTS; ++c) normal[c] = QPC_LOAD(&s->row_normal[c][slot + i]);
    for (int c = 0; c < QPC_COMPONENTS; ++c) {
      forces[c] += normal[c] * pull;
      for (int e = 0; e <= c && !aim.corrected; ++e) weights[c * (c + 1) / 2 + e] += weight * normal[c] * normal[e];
    }
    if (index >= 0) continue;
    for (int c = 0; c < QPC_COMPONENTS; ++c) {
      double* force = &s->ip_force[qpc_output_place[o][c] + i];
      QPC_STORE(force, QPC_LOAD(force) + forces[c]);
      forces[c] = (qpc_vector){0};
    }
    for (int j = 0; j < QPC_WEIGHTS && !aim.corrected; ++j) {
      QPC_STORE(&s->ip_weight[o][j][i], QPC_LOAD(&s->ip_weight[o][j][i]) + weights[j]);
      weights[j] = (qpc_vector){0};
    }
  }
  if (index < 0) return;
  for (int c = 0; c < QPC_COMPONENTS; ++c) s->ip_force[qpc_output_place[o][c] + index] += qpc_sum(forces[c]);
  for (int j = 0; j < QPC_WEIGHTS && !aim.corrected; ++j) s->ip_weight[o][j][index] += qpc_sum(weights[j]);
}

QPC_FUNCTION void qpc_ip_bound_forces(qpc_solver* s, int first, int count, double step, qpc_aim aim) {
  for (int i = first; i < first + count; i += QPC_WIDTH) {
    qpc_vector lower_weight, upper_weight;
    const int below = QPC_ROW_SLOTS + i, above = below + QPC_BLOCKS * QPC_POINTS_PADDED;
    if (!aim.corrected) {
      qpc_ip_advance(s, below, step);
      qpc_ip_advance(s, above, step);
    }
    const qpc_vector up = qpc_ip_pull(s, below, QPC_LOAD(&s->lower[i]), aim, &lower_weight);
    const qpc_vector down = qpc_ip_pull(s, above, -QPC_LOAD(&s->upper[i]), aim, &upper_weight);
    QPC_STORE(&s->ip_force[i], QPC_LOAD(&s->ip_force[i]) + up - down);
    if (!aim.corrected) QPC_STORE(&s->ip_diagonal[i], lower_weight + upper_weight);
  }
}

/* Terms 1/2 weight (n . y - offset)^2. */
static void qpc_ip_quadratic_forces(qpc_solver* s, qpc_aim aim) {
  for (int i = 0; i < s->quadratic_count; ++i) {
    const int o = s->quadratic_output[i], index = s->quadratic_index[i];
    for (int c = 0; c < QPC_COMPONENTS; ++c) {
      const double along = s->quadratic_weight[i] * s->quadratic_normal[i][c];
      s->ip_force[qpc_output_place[o][c] + index] += along * s->quadratic_offset[i];
      for (int e = 0; e <= c && !aim.corrected; ++e) {
        s->ip_weight[o][c * (c + 1) / 2 + e][index] += along * s->quadratic_normal[i][e];
      }
    }
  }
}

static void qpc_ip_forces(qpc_solver* s, double step, qpc_aim aim) {
  qpc_clear(s->ip_force, QPC_BLOCKS * QPC_POINTS_PADDED);
  if (!aim.corrected) qpc_clear(&s->ip_weight[0][0][0], QPC_OUTPUTS * QPC_WEIGHTS * QPC_STAGES_PADDED);
  qpc_ip_quadratic_forces(s, aim);
  for (int b = 0; b < QPC_BLOCKS; ++b) {
    for (int range = 0; range < QPC_BOUND_RANGES; ++range) {
      const int first = b * QPC_POINTS_PADDED + qpc_bound_range[2 * range];
      if (aim.corrected) {
        qpc_ip_bound_forces(s, first, qpc_bound_range[2 * range + 1], 0.0, (qpc_aim){aim.centre, 1});
      } else {
        qpc_ip_bound_forces(s, first, qpc_bound_range[2 * range + 1], step, (qpc_aim){0.0, 0});
      }
    }
  }
  for (int group = 0; group < s->group_count; ++group) {
    if (aim.corrected) {
      qpc_ip_group_forces(s, group, 0.0, (qpc_aim){aim.centre, 1});
    } else {
      qpc_ip_group_forces(s, group, step, (qpc_aim){0.0, 0});
    }
  }
}

/* Directions of all rows to the outputs just solved for; returns the longest step up to 1 that keeps everything
   positive. */
QPC_FUNCTION double qpc_ip_directions(qpc_solver* s, qpc_aim aim, double* linear, double* quadratic) {
  qpc_ratio ratio;
  for (int i = 0; i < 4; ++i) {
    ratio.numerator[i] = QPC_BROADCAST(1.0);
    ratio.denominator[i] = QPC_BROADCAST(1.0);
  }
  ratio.linear = ratio.quadratic = (qpc_vector){0};
  for (int group = 0; group < s->group_count; ++group) {
    const int output = s->group_output[group], index = s->group_index[group], slot = s->group_slot[group];
    qpc_vector y[QPC_COMPONENTS];
    for (int c = 0; c < QPC_COMPONENTS && index >= 0; ++c) {
      y[c] = QPC_BROADCAST(s->output[qpc_output_place[output][c] + index]);
    }
    for (int i = 0; i < s->group_rows[group]; i += QPC_WIDTH) {
      qpc_vector value = {0};
      for (int c = 0; c < QPC_COMPONENTS; ++c) {
        if (index < 0) y[c] = QPC_LOAD(&s->output[qpc_output_place[output][c] + i]);
        value += QPC_LOAD(&s->row_normal[c][slot + i]) * y[c];
      }
      qpc_ip_direction(s, slot + i, value, QPC_LOAD(&s->row_offset[slot + i]), aim, &ratio);
    }
  }
  for (int b = 0; b < QPC_BLOCKS; ++b) {
    for (int range = 0; range < QPC_BOUND_RANGES; ++range) {
      const int first = b * QPC_POINTS_PADDED + qpc_bound_range[2 * range];
      for (int i = first; i < first + qpc_bound_range[2 * range + 1]; i += QPC_WIDTH) {
        const int below = QPC_ROW_SLOTS + i, above = below + QPC_BLOCKS * QPC_POINTS_PADDED;
        const qpc_vector y = QPC_LOAD(&s->output[i]);
        qpc_ip_direction(s, below, y, QPC_LOAD(&s->lower[i]), aim, &ratio);
        qpc_ip_direction(s, above, -y, -QPC_LOAD(&s->upper[i]), aim, &ratio);
      }
    }
  }
  double largest = 1.0;
  for (int i = 0; i < 4; ++i) {
    const qpc_vector shrink = ratio.numerator[i] / ratio.denominator[i];
    for (int lane = 0; lane < QPC_WIDTH; ++lane) largest = shrink[lane] > largest ? shrink[lane] : largest;
  }
  *linear = qpc_sum(ratio.linear);
  *quadratic = qpc_sum(ratio.quadratic);
  return 1.0 / largest;
}
