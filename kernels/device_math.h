/* For every kernel, before lane_math.h. */
#ifndef TOUCHSTONE_DEVICE_MATH_H
#define TOUCHSTONE_DEVICE_MATH_H

/* Without the attribute PoCL calls: integration takes 9.0 instead of 5.7 ms. */
#define INLINE static inline __attribute__((always_inline))

#endif
