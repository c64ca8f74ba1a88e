/* The only header that host and device share: scalars and 4-vectors only, no 3-vectors. OpenCL C 1.2 and C++20.
 * A probe kernel reports size and offsets of each struct; tests/kernels compares them with the host's. */
#ifndef TOUCHSTONE_SHARED_TYPES_H
#define TOUCHSTONE_SHARED_TYPES_H

#ifdef __OPENCL_VERSION__
typedef float4 Float4;
#else
namespace touchstone {
struct alignas(16) Float4 {
    float x, y, z, w;
};
#endif

/* Pinhole camera: u = fx x/z + cx, pixel centres at whole numbers. */
typedef struct Intrinsics {
    float fx_px, fy_px, cx_px, cy_px;
    int width_px, height_px;
    int reserved[2];
} Intrinsics;

/* Rows of the 3x4 matrix [R t] that takes points of the second frame named to the first: T_g_c, camera to global. */
typedef struct Pose {
    Float4 row_x, row_y, row_z;
} Pose;

/* sigma_z(z, theta) = constant + quadratic (z - offset)^2 + grazing / sqrt(z) (theta / (pi/2 - theta))^2, metres.
 * Nguyen et al. 2012. */
typedef struct SensorNoise {
    float constant_m, quadratic, offset_m, grazing;
} SensorNoise;

#ifndef __OPENCL_VERSION__
} /* namespace touchstone */
#endif

#endif
