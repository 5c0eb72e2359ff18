/* ---- Interior point: primal-dual, predictor and corrector. ----
   Every row has room = n . y + slack - offset >= 0 with its multiplier, and, if it is soft, slack >= 0 with the
   multiplier reserve = linear + quadratic slack - multiplier. Eliminating all four from Newton's equations leaves a
   weight n n' / (room / multiplier + slack / (quadratic slack + reserve) + proximal) on the row's output and a force
   along n: the problem without rows, with other costs, which the Riccati recursion solves.

   `proximal` bounds the weights, without which the recursion may run out of digits: each step is that of a proximal
   method of multipliers, n . y + slack - room = offset - proximal (step of the multiplier). The optimum is the same, but
   takes more steps where rows depend on each other, so it is 0 until the digits do run out. */

#define QPC_IP_FRACTION 0.995 /* of the way to the boundary that a step may go */
#define QPC_IP_START 1.0 /* each complementarity at the start, in units of the cost */

enum { QPC_LAMBDA, QPC_ROOM, QPC_SLACK, QPC_RESERVE };

/* What the complementarities are steered to: `centre`; with the second-order terms in the corrector. */
typedef struct {
  double centre;
  int corrected;
} qpc_aim;

/* The largest -step / value of each variable and lane so far, as a fraction, and how the complementarity changes with
   the step a: linear a + quadratic a^2. */
typedef struct {
  qpc_vector numerator[4], denominator[4];
  qpc_vector linear, quadratic;
} qpc_ratio;

QPC_FUNCTION double qpc_sum(qpc_vector v) {
  double sum = 0.0;
  for (int i = 0; i < QPC_WIDTH; ++i) sum += v[i];
  return sum;
}

QPC_FUNCTION qpc_vector qpc_only(qpc_mask mask, qpc_vector v) { return (qpc_vector)(mask & (qpc_mask)v); }

/* Takes a step, and refreshes what depends on the variables. Returns the sum of the complementarities, which is the
   duality gap once the residuals have vanished; `residual` is the largest of these, `price` what they all cost. From
   then on rows give way by `give`. */
static double qpc_ip_advance(qpc_solver* s, double step, double give, double* residual, double* price) {
  qpc_vector gap = {0}, largest = {0}, cost = {0};
  for (int e = 0; e < s->ip_count; e += QPC_WIDTH) {
    qpc_vector v[4];
    for (int i = 0; i < 4; ++i) {
      v[i] = QPC_LOAD(&s->ip_variable[i][e]) + QPC_LOAD(&s->ip_step[i][e]) * step;
      QPC_STORE(&s->ip_variable[i][e], v[i]);
    }
    gap += v[QPC_LAMBDA] * v[QPC_ROOM] + v[QPC_SLACK] * v[QPC_RESERVE];
    const qpc_vector inverse_reserve = 1.0 / (QPC_LOAD(&s->ip_quadratic[e]) * v[QPC_SLACK] + v[QPC_RESERVE]);
    const qpc_vector self = QPC_LOAD(&s->ip_self[e]);
    const qpc_vector r =
        QPC_LOAD(&s->ip_residual[e]) * (1.0 - step) -
                         self * QPC_LOAD(&s->ip_step[QPC_LAMBDA][e]) * (s->ip_give * step);
    largest = qpc_maximum(largest, qpc_maximum(r, -r));
    cost += v[QPC_LAMBDA] * qpc_maximum(r, -r);
    QPC_STORE(&s->ip_residual[e], r);
    QPC_STORE(&s->ip_inverse_reserve[e], inverse_reserve);
    QPC_STORE(&s->ip_inverse_room[e],
              1.0 / (v[QPC_ROOM] + v[QPC_LAMBDA] * (v[QPC_SLACK] * inverse_reserve + self * give)));
  }
  s->ip_give = give;
  *price = qpc_sum(cost);
  *residual = 0.0;
  for (int i = 0; i < QPC_WIDTH; ++i) *residual = largest[i] > *residual ? largest[i] : *residual;
  return qpc_sum(gap);
}

/* Every row's force along its normal. */
QPC_FUNCTION void qpc_ip_pulls(qpc_solver* s, qpc_aim aim) {
  for (int e = 0; e < s->ip_count; e += QPC_WIDTH) {
    const qpc_vector lambda = QPC_LOAD(&s->ip_variable[QPC_LAMBDA][e]), slack = QPC_LOAD(&s->ip_variable[QPC_SLACK][e]);
    const qpc_vector inverse_room = QPC_LOAD(&s->ip_inverse_room[e]);
    qpc_vector first = QPC_BROADCAST(aim.centre), second = first;
    if (aim.corrected) {
      first -= QPC_LOAD(&s->ip_product[0][e]);
      second -= QPC_LOAD(&s->ip_product[1][e]);
    }
    second = qpc_only((qpc_mask)(slack > 0.0), second) - QPC_LOAD(&s->ip_variable[QPC_RESERVE][e]) * slack;
    const qpc_vector room = QPC_LOAD(&s->ip_variable[QPC_ROOM][e]) + QPC_LOAD(&s->ip_residual[e]);
    QPC_STORE(&s->ip_pull[e],
              lambda + inverse_room * (first - lambda * (room + QPC_LOAD(&s->ip_inverse_reserve[e]) * second)));
  }
}

/* Sums forces, and in the predictor weights, by output and stage. */
QPC_FUNCTION void qpc_ip_gather(qpc_solver* s, qpc_aim aim) {
  qpc_clear(s->ip_force, QPC_BLOCKS * QPC_POINTS_PADDED);
  if (!aim.corrected) qpc_clear(&s->ip_weight[0][0][0], QPC_OUTPUTS * QPC_WEIGHTS * QPC_STAGES_PADDED);
  for (int i = 0; i < s->quadratic_count; ++i) {
    const int o = s->quadratic_output[i], index = s->quadratic_index[i];
    double off = s->quadratic_offset[i];
    for (int c = 0; c < QPC_COMPONENTS; ++c) {
      off -= s->quadratic_normal[i][c] * s->ip_output[qpc_output_place[o][c] + index];
    }
    for (int c = 0; c < QPC_COMPONENTS; ++c) {
      const double along = s->quadratic_weight[i] * s->quadratic_normal[i][c];
      s->ip_force[qpc_output_place[o][c] + index] += along * off;
      for (int d = 0; d <= c && !aim.corrected; ++d) {
        s->ip_weight[o][c * (c + 1) / 2 + d][index] += along * s->quadratic_normal[i][d];
      }
    }
  }
  for (int e = 0; e < s->ip_count; ++e) {
    const int o = s->ip_group[0][e], index = s->ip_group[1][e];
    const double weight = s->ip_variable[QPC_LAMBDA][e] * s->ip_inverse_room[e];
    for (int c = 0; c < QPC_COMPONENTS; ++c) {
      const double normal = s->ip_normal[c][e];
      s->ip_force[s->ip_place[c][e]] += normal * s->ip_pull[e];
      for (int d = 0; d <= c && !aim.corrected; ++d) {
        s->ip_weight[o][c * (c + 1) / 2 + d][index] += weight * normal * s->ip_normal[d][e];
      }
    }
  }
}

QPC_FUNCTION void qpc_ip_limit(qpc_ratio* ratio, int i, qpc_vector value, qpc_vector step) {
  const qpc_mask larger = (qpc_mask)(-step * ratio->denominator[i] > ratio->numerator[i] * value);
  ratio->numerator[i] = qpc_select(larger, -step, ratio->numerator[i]);
  ratio->denominator[i] = qpc_select(larger, value, ratio->denominator[i]);
}

/* Directions of QPC_WIDTH rows' variables. */
QPC_FUNCTION void qpc_ip_direction(qpc_solver* s, int e, qpc_aim aim, qpc_ratio* ratio) {
  qpc_vector v[4], d[4];
  for (int i = 0; i < 4; ++i) v[i] = QPC_LOAD(&s->ip_variable[i][e]);
  const qpc_vector value = QPC_LOAD(&s->ip_value[e]);
  const qpc_mask soft = (qpc_mask)(v[QPC_SLACK] > 0.0);
  qpc_vector second = QPC_BROADCAST(aim.centre);
  if (aim.corrected) second -= QPC_LOAD(&s->ip_product[1][e]);
  second = qpc_only(soft, second) - v[QPC_RESERVE] * v[QPC_SLACK];
  d[QPC_LAMBDA] = qpc_only((qpc_mask)(QPC_LOAD(&s->ip_offset[e]) > -0.5 * QPC_UNBOUNDED),
                           QPC_LOAD(&s->ip_pull[e]) -
                               v[QPC_LAMBDA] * (1.0 + QPC_LOAD(&s->ip_inverse_room[e]) * value));
  d[QPC_SLACK] = (v[QPC_SLACK] * d[QPC_LAMBDA] + second) * QPC_LOAD(&s->ip_inverse_reserve[e]);
  d[QPC_ROOM] = value + d[QPC_SLACK] + QPC_LOAD(&s->ip_residual[e]) +
                QPC_LOAD(&s->ip_self[e]) * s->ip_give * d[QPC_LAMBDA];
  d[QPC_RESERVE] = qpc_only(soft, QPC_LOAD(&s->ip_quadratic[e]) * d[QPC_SLACK] - d[QPC_LAMBDA]);
  for (int i = 0; i < 4; ++i) qpc_ip_limit(ratio, i, v[i], d[i]);
  const qpc_vector first_product = d[QPC_LAMBDA] * d[QPC_ROOM], second_product = d[QPC_SLACK] * d[QPC_RESERVE];
  ratio->linear += v[QPC_LAMBDA] * d[QPC_ROOM] + v[QPC_ROOM] * d[QPC_LAMBDA] + v[QPC_SLACK] * d[QPC_RESERVE];
  ratio->linear += qpc_only(soft, v[QPC_RESERVE] * d[QPC_SLACK]);
  ratio->quadratic += first_product + second_product;
  if (aim.corrected) {
    for (int i = 0; i < 4; ++i) QPC_STORE(&s->ip_step[i][e], d[i]);
  } else {
    QPC_STORE(&s->ip_product[0][e], first_product);
    QPC_STORE(&s->ip_product[1][e], second_product);
  }
}

/* Directions that go with the outputs' step just solved for; returns the longest step up to 1 / QPC_IP_FRACTION that
   keeps everything positive. */
QPC_FUNCTION double qpc_ip_directions(qpc_solver* s, qpc_aim aim, double* linear, double* quadratic) {
  qpc_ratio ratio;
  double largest = QPC_IP_FRACTION;
  for (int i = 0; i < 4; ++i) {
    ratio.numerator[i] = QPC_BROADCAST(QPC_IP_FRACTION);
    ratio.denominator[i] = QPC_BROADCAST(1.0);
  }
  ratio.linear = ratio.quadratic = (qpc_vector){0};
  for (int e = 0; e < s->ip_count; ++e) {
    double value = 0.0;
    for (int c = 0; c < QPC_COMPONENTS; ++c) value += s->ip_normal[c][e] * s->output[s->ip_place[c][e]];
    s->ip_value[e] = value;
  }
  for (int e = 0; e < s->ip_count; e += QPC_WIDTH) qpc_ip_direction(s, e, aim, &ratio);
  for (int i = 0; i < 4; ++i) {
    const qpc_vector shrink = ratio.numerator[i] / ratio.denominator[i];
    for (int lane = 0; lane < QPC_WIDTH; ++lane) largest = shrink[lane] > largest ? shrink[lane] : largest;
  }
  *linear = qpc_sum(ratio.linear);
  *quadratic = qpc_sum(ratio.quadratic);
  return 1.0 / largest;
}
