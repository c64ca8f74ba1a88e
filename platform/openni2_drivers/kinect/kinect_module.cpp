#include "platform/openni2_drivers/kinect/kinect_driver.hpp"

ONI_EXPORT_DRIVER(touchstone::KinectDriver)
