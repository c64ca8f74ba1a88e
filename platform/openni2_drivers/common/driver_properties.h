/* Device properties that drivers of ours have beyond OpenNI2's own, for DepthCamera and any other OpenNI2
 * program. Read and write them through openni::Device::getProperty and setProperty; sizes must match exactly.
 */
#ifndef TOUCHSTONE_DRIVER_PROPERTIES_H
#define TOUCHSTONE_DRIVER_PROPERTIES_H

enum {
    /* int, read and write before the first stream starts: a TouchstonePace. */
    TOUCHSTONE_DEVICE_PROPERTY_PACE = 0x54530001,
    /* Intrinsics (kernels/shared_types.h) of the depth picture, read only. OpenNI2 itself only knows fields
       of view. */
    TOUCHSTONE_DEVICE_PROPERTY_INTRINSICS = 0x54530002,
    /* TouchstoneDriverError, read only: why the device went to ONI_DEVICE_STATE_ERROR. */
    TOUCHSTONE_DEVICE_PROPERTY_LAST_ERROR = 0x54530003,
    /* int, read and write: a TouchstoneLight, what the device's light shows. Kinect. */
    TOUCHSTONE_DEVICE_PROPERTY_LIGHT = 0x54530004,
    /* float, read and write: the head's tilt in degrees against the horizon, up is positive, -30 to 30.
       Reading gives the present angle; writing starts the motor, which takes seconds. Not for use many times
       a minute: the motor rests then by itself. Kinect. */
    TOUCHSTONE_DEVICE_PROPERTY_TILT = 0x54530005,
    /* TouchstoneVector, read only: gravity as the accelerometer feels it, m/s^2, in the camera's frame (x
       right, y down, z forward, depth picture not mirrored). Kinect. */
    TOUCHSTONE_DEVICE_PROPERTY_GRAVITY = 0x54530006,
    /* unsigned long long, read only: packets of depth and colour that USB lost since the driver was loaded. Does
       not wait. Kinect. */
    TOUCHSTONE_DEVICE_PROPERTY_LOST_PACKETS = 0x54530007
};

enum TouchstoneLight {
    TOUCHSTONE_LIGHT_OFF = 0,
    TOUCHSTONE_LIGHT_GREEN = 1,
    TOUCHSTONE_LIGHT_BLINKING_GREEN = 2,
    TOUCHSTONE_LIGHT_RED = 3
};

typedef struct TouchstoneVector {
    float x, y, z;
} TouchstoneVector;

enum TouchstonePace {
    TOUCHSTONE_PACE_LIVE = 0, /* frames come at the source's rate; a slow reader gets the latest */
    TOUCHSTONE_PACE_STEP = 1  /* a frame is made when a reader waits for one */
};

enum { TOUCHSTONE_ERROR_TEXT_SIZE = 1024 };

typedef struct TouchstoneDriverError {
    int exit_status; /* of sysexits.h, 0 = no error */
    char message[TOUCHSTONE_ERROR_TEXT_SIZE];
} TouchstoneDriverError;

/* A device that cannot be opened has no properties: the error then stands in OpenNI's extended error as
 * PREFIX <exit status> ' ' <message> SUFFIX. */
#define TOUCHSTONE_ERROR_PREFIX "[touchstone-error "
#define TOUCHSTONE_ERROR_SUFFIX "\x1e"

#endif
