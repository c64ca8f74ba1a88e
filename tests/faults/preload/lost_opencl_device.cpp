// LD_PRELOAD: an OpenCL device that is gone, as a GPU after a reset of its driver is.
#include <CL/cl.h>
#include <dlfcn.h>

#include "tests/faults/preload/fault_switch.hpp"

extern "C" cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                                         const size_t* offset, const size_t* global, const size_t* local,
                                         cl_uint waits, const cl_event* wait_list, cl_event* event) {
    static const auto next =
        reinterpret_cast<decltype(&clEnqueueNDRangeKernel)>(dlsym(RTLD_NEXT, "clEnqueueNDRangeKernel"));
    if (fault_is_on()) return CL_OUT_OF_RESOURCES;
    return next(queue, kernel, dimensions, offset, global, local, waits, wait_list, event);
}

extern "C" cl_int clFinish(cl_command_queue queue) {
    static const auto next = reinterpret_cast<decltype(&clFinish)>(dlsym(RTLD_NEXT, "clFinish"));
    return fault_is_on() ? CL_INVALID_COMMAND_QUEUE : next(queue);
}
