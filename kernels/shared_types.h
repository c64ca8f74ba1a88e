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

/* Size of every per-pixel map of one camera. pitch and rows are width and height rounded up to whole tiles of
 * TILE_PX x TILE_PX; pixels beyond the picture are invalid. A map of k planes holds plane after plane. */
#define TILE_PX 16
typedef struct MapShape {
    int width_px, height_px, pitch_px, rows_px;
} MapShape;

/* Bilateral filter: weight (1 - e/8)^8 for e < 8 of e = du^2/(2 sigma_px^2) + dz^2/(2 sigma^2), where sigma is range_sigmas sigma_z,
 * at most a quarter of the depth. */
typedef struct FilterParams {
    SensorNoise noise;
    float spatial_sigma_px, range_sigmas, min_depth_m, max_depth_m;
} FilterParams;

/* A cube of size_vox^3 voxels in bricks of BRICK_VOX^3. The global frame has its origin in the cube's corner.
 * Voxel i covers [i, i+1) voxel_m; its sample is at the centre. */
#define BRICK_VOX 8
#define BRICK_VOXELS 512
typedef struct VolumeParams {
    float voxel_m, max_truncation_m, min_truncation_m;
    int size_vox, bricks_per_side, max_weight;
    int reserved[2];
} VolumeParams;

/* A pixel's weight in Listing 2 is most (reference_sigma_m / sigma_z(z, theta))^2, from 1 to most; none where the surface is
 * seen at a cosine below min_cos or the pixel is between two neighbours more than gap_per_m z before and behind it. */
typedef struct SampleWeightParams {
    SensorNoise noise;
    float reference_sigma_m, min_cos, gap_per_m;
    int most;
} SampleWeightParams;

/* Voxels nearer to the surface than band_vox take the colour of pixels that see it at a cosine above min_cos and are guard_px away
 * from a depth edge: where depths differ by more than gap_per_m, over what the slope allows. */
typedef struct ColorParams {
    SensorNoise noise;
    float band_vox, min_cos, gap_per_m;
    int guard_px;
} ColorParams;

/* What a brick is to the present depth picture. */
#define BRICK_EDGE_PIXELS 6
enum BrickClass { BRICK_HIDDEN = 0, BRICK_NEAR_SURFACE = 1, BRICK_FREE_SPACE = 2 };

/* A voxel is one int: bits 0-15 TSDF / max_truncation * TSDF_SCALE, bits 16-23 weight (0 = unknown),
 * bits 24-31 signed average of the TSDF's change * CHANGE_SCALE (for the adaptive weight of moving surfaces). */
#define TSDF_SCALE 32766.0f

/* Listing 2 for what moves: the stored weight is kept while the average of the TSDF's change stays below calm_sigmas of the
 * sensor's noise, is down to least_weight from moving_sigmas on, and between them falls with the square. A sample counts
 * change_share in that average. Pixels of weight SAMPLE_FREE_ONLY say where nothing is, not where a surface is. */
#define SAMPLE_FREE_ONLY 255
#define CHANGE_SCALE 127.0f
typedef struct AdaptiveWeightParams {
    float change_share, calm_sigmas, moving_sigmas;
    int least_weight;
} AdaptiveWeightParams;

/* Where a pixel of the foreground's surface comes from. */
enum ForegroundSource { FOREGROUND_NONE = 0, FOREGROUND_LIVE = 1, FOREGROUND_MODEL = 2 };

/* Listing 4: the foreground overlaps the background where its signed distance to it, in metres, is more than
 * -threshold_sigmas sigma_z and less than finger_thickness_m + threshold_sigmas sigma_z. */
#define UNKNOWN_HEIGHT_M 100.0f
typedef struct TouchMapParams {
    SensorNoise noise;
    float finger_thickness_m, threshold_sigmas;
    int reserved[2];
} TouchMapParams;

/* Why a live pixel has no counterpart in the prediction (the outlier map of Fig 14b). The last is only a hint: such a
 * pixel is at the depth of the model. */
enum RejectionCode {
    ASSOCIATION_INLIER = 0,
    ASSOCIATION_NO_LIVE_DEPTH = 1,
    ASSOCIATION_NO_MODEL = 2,
    ASSOCIATION_IN_FRONT = 3,
    ASSOCIATION_SLIGHTLY_IN_FRONT = 4,
    ASSOCIATION_BEHIND = 5,
    ASSOCIATION_NORMAL_DIFFERS = 6
};

/* Two depths agree when 1/z differs by less than so many sigmas; sigma^2 = (sigma_z / z^2)^2 + quantisation^2. */
typedef struct AssociationParams {
    SensorNoise noise;
    float quantisation_per_m; /* standard deviation of 1/z by rounding to steps of disparity, 1/m */
    float sigmas_high;        /* in front: surely */
    float sigmas_low;         /* in front: where a sure pixel is connected to it */
    float min_normal_cos;     /* -1: the normals of the live picture are not compared */
} AssociationParams;

/* From codes to candidates. Tolerances as in AssociationParams, for a surface that faces the camera. */
typedef struct CandidateParams {
    SensorNoise noise;
    float quantisation_per_m, sigmas_high;
    float jump_per_m;      /* the model has an edge where its depth changes by more than this times the depth */
    float unknown_depth_m; /* how far away the surface is taken to be where nothing was ever seen */
} CandidateParams;

/* Histograms of what live 1/z exceeds the model's by, per column and zone of rows: DRIFT_BINS bins of bin_per_m around 0;
 * rows first_row, first_row + row_step, ... */
#define DRIFT_BINS 16
#define DRIFT_ZONES 4
typedef struct DriftParams {
    float bin_per_m;
    int first_row, row_step, reserved;
} DriftParams;

/* Pixels given to connected components: 0 is none of them; the others are counted apart. MEMBER_EXPECTED is added to one
 * of them where the foreground was a moment ago. */
enum ComponentMember { MEMBER_NONE = 0, MEMBER_GROWTH = 1, MEMBER_SEED = 2, MEMBER_UNKNOWN = 3, MEMBER_EXPECTED = 4 };

/* Neighbours are connected when their depths differ by less than max(gap_sigmas sigma_z(z), gap_per_m z). */
typedef struct ConnectionParams {
    SensorNoise noise;
    float gap_sigmas, gap_per_m;
} ConnectionParams;

/* Sums over one connected component; the last column and row are part of it. */
typedef struct ComponentSums {
    int root; /* map index of its first pixel, row by row */
    int pixels, seeds, unknowns;
    int min_x, min_y, max_x, max_y;
    int depth_mm_low, depth_mm_high; /* sum of depths = high 2^16 + low, millimetres */
    int expected, reserved;
} ComponentSums;

/* Base colours 0..1, w: how much they shine; the light's direction in the camera frame, from the light. */
typedef struct ShadingParams {
    Float4 background, foreground, unknown, light_c;
} ShadingParams;

/* Instead of a slot: rays may pass the brick, or the whole group of bricks that it is in. */
#define SKIP_GROUP_BRICKS 4
enum BrickSkip { SKIP_BRICK = -1, SKIP_GROUP = -2 };

/* Lighting of a view from anywhere. Global frame, metres; colours 0..1. A pixel's colour is base (ambient + diffuse cos(n, l) v) +
 * surface.w cos(r, view)^16 v for the share v of the light that reaches it: 0 below cos(n, l) = 0, whole from grazing_cos on.
 * Shadow rays start start_vox voxels over the surface. Of every mesh_step-th pixel and row of the mesh's maps; 0: there is no mesh. */
typedef struct ViewLightingParams {
    Float4 light_g_m, sphere_g_m; /* sphere's w: radius, 0 where there is none */
    Float4 surface;               /* colour where the volume has none; w: how much it shines */
    Float4 unknown;               /* where rays of the view meet nothing; mirrored ones see the sky */
    Float4 sky_low, sky_high, up_g;
    Float4 low_vox, high_vox; /* beyond this box secondary rays meet nothing */
    float ambient, diffuse, grazing_cos, start_vox;
    float mirror; /* share of the light that the sphere reflects */
    int mesh_step, has_colors, reserved;
} ViewLightingParams;

/* Point-to-plane alignment (Listing 1, Eq 1) of live vertices with a prediction, both in the prediction's frame p.
 * A pair counts where the vertices are at most max_distance_m apart, the normals agree and the residual is below
 * cutoff_sigmas sigma_z(z, theta); its row weighs (reference_sigma_m / sigma_z)^2 times Huber's weight. The twist turns
 * about centre_p. Rows of brightness (0..1) weigh (reference_sigma_m / intensity_sigma)^2 times Huber's weight. */
typedef struct AlignmentParams {
    SensorNoise noise;
    Float4 centre_p;
    float max_distance_m, min_normal_cos, huber_sigmas, cutoff_sigmas;
    float reference_sigma_m, intensity_sigma;
    int reserved[2];
} AlignmentParams;

/* What a row of pixels adds to the normal equations A x = b, x = (omega, t): A's upper triangle row by row, b, then sums of
 * weight, weight * residual^2, pairs that count, pairs compared (a model is there), live pixels, residual^2, pairs within 2 sigma_z, 0. */
#define ALIGNMENT_SUMS 35
#define ALIGNMENT_B 21
#define ALIGNMENT_STATISTICS 27

#define SORT_BITS 9
#define SORT_DIGITS 512
#define SORT_RUN 512

/* Spheres in a box. What a contact does is over the mass of a particle: stiffness 1/s^2, damping and shear 1/s, friction 1. Values of
 * a plane of a state: plane, and still_plane of that of the still ones. */
#define PARTICLE_CELLS 131072
typedef struct ParticleParams {
    Float4 gravity, low_m, high_m, still_low_m, still_high_m; /* the last two: around the middles of the still ones */
    float radius_m, still_radius_m, stiffness, damping, shear, friction;
    float dt_s, max_speed, cell_m, still_cell_m;
    int count, plane, still_plane, has_surface;
    int reserved[3];
} ParticleParams;

#ifndef __OPENCL_VERSION__
} /* namespace touchstone */
#endif

#endif
