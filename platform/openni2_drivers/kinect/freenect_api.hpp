#pragma once

#include <libfreenect.h>
#include <libfreenect_registration.h>

// OpenNI2 loads drivers with all symbols bound. libfreenect's player of recordings lacks these: they are null
// there instead of keeping the driver from loading.
extern "C" {
#pragma weak freenect_copy_registration
#pragma weak freenect_destroy_registration
#pragma weak freenect_enabled_subdevices
#pragma weak freenect_set_flag
}
