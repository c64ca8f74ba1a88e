// For builds with a sanitizer: drivers stay loaded when OpenNI2 unloads them, so that a report can name the
// module it is about, and the suppressions for OpenNI2's own leaks can match.
extern "C" int dlclose(void*) { return 0; }
