#pragma once

// OniDriverAPI.h uses these two without defining them.
#include <new>

#define XN_NEW(type, ...) new (std::nothrow) type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)

#include <Driver/OniDriverAPI.h>
