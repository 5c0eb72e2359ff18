#if defined(__FAST_MATH__)
#error "compile without -ffast-math: the checks for numbers that are not finite would vanish"
#endif
/* No call may appear that the source does not contain: no memset for a loop that clears. */
#if defined(__clang__)
#pragma clang attribute push(__attribute__((no_builtin("memset", "memcpy", "memmove"))), apply_to = function)
#elif defined(__GNUC__)
#pragma GCC optimize("no-tree-loop-distribute-patterns")
#endif
/* The functions' suffix, the instruction set: give it when compiling, -DQPC_SET=avx2. */
#ifndef QPC_SET
#define QPC_SET baseline
#endif
#define QPC_PASTE(name, set) qpc_##name##_##set
#define QPC_PASTE_EXPANDED(name, set) QPC_PASTE(name, set)
#define qpc_function(name) QPC_PASTE_EXPANDED(name, QPC_SET)

#define QPC_FUNCTION static inline __attribute__((always_inline, unused))

/* Vectors of the instruction set that this object is compiled for. Loads and stores need no alignment. */
#if defined(__AVX512F__)
#define QPC_WIDTH 8
#elif defined(__AVX2__)
#define QPC_WIDTH 4
#else
#define QPC_WIDTH 2
#endif
typedef double qpc_vector __attribute__((vector_size(QPC_WIDTH * 8)));
typedef double qpc_vector_memory __attribute__((vector_size(QPC_WIDTH * 8), aligned(8), may_alias));
typedef int64_t qpc_mask __attribute__((vector_size(QPC_WIDTH * 8)));
#define QPC_TILE_POINTS (QPC_POINTS_PADDED / QPC_TILES) /* points of a block that are summed in registers */
#define QPC_TILE (QPC_TILE_POINTS / QPC_WIDTH)
#define QPC_LOAD(pointer) (*(const qpc_vector_memory*)(pointer))
#define QPC_STORE(pointer, value) (*(qpc_vector_memory*)(pointer) = (value))
#define QPC_BROADCAST(value) ((value) - (qpc_vector){0})

#if QPC_LANES > 1
typedef double qpc_lane __attribute__((vector_size(QPC_LANES * 8)));
typedef double qpc_lane_memory __attribute__((vector_size(QPC_LANES * 8), aligned(8), may_alias));
#define QPC_LOAD_LANE(pointer) ((qpc_lane)(*(const qpc_lane_memory*)(pointer)))
#define QPC_STORE_LANE(pointer, value) (*(qpc_lane_memory*)(pointer) = (value))
#define QPC_LANE_ENTRY(value, lane) ((value)[lane])
#define QPC_LANE_ZERO ((qpc_lane){0})
#else
typedef double qpc_lane;
#define QPC_LOAD_LANE(pointer) (*(pointer))
#define QPC_STORE_LANE(pointer, value) (*(pointer) = (value))
#define QPC_LANE_ENTRY(value, lane) (value)
#define QPC_LANE_ZERO 0.0
#endif

#define QPC_UNBOUNDED 1e300
#define QPC_ROUND_UP(n, to) (((n) + (to)-1) / (to) * (to))

static int qpc_is_finite(double value) {
  union {
    double number;
    uint64_t bits;
  } view;
  view.number = value;
  return (view.bits & 0x7ff0000000000000u) != 0x7ff0000000000000u;
}

static double qpc_magnitude(double value) { return value < 0.0 ? -value : value; }

static void qpc_clear(double* first, int count) {
  for (int i = 0; i < count; ++i) first[i] = 0.0;
}

/* Sums the products with 0, which are 0 unless a number is not finite. */
static int qpc_all_finite(const double* first, int count) {
  qpc_vector sum = {0}, other = {0};
  double rest = 0.0;
  int i = 0;
  for (; i + 2 * QPC_WIDTH <= count; i += 2 * QPC_WIDTH) {
    sum += QPC_LOAD(first + i) * 0.0;
    other += QPC_LOAD(first + i + QPC_WIDTH) * 0.0;
  }
  for (; i < count; ++i) rest += first[i] * 0.0;
  sum += other;
  for (i = 0; i < QPC_WIDTH; ++i) rest += sum[i];
  return rest == 0.0;
}

QPC_FUNCTION qpc_vector qpc_select(qpc_mask mask, qpc_vector yes, qpc_vector no) {
  return (qpc_vector)((mask & (qpc_mask)yes) | (~mask & (qpc_mask)no));
}
