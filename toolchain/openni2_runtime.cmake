# OpenNI2 loads OpenNI2/Drivers/lib*.so.0 beside the path from which libOpenNI2.so.0 itself was loaded. So the build
# tree gets a folder of links to the system's library and its drivers, with our drivers beside them, and executables
# find the library there first.
set(runtime ${PROJECT_BINARY_DIR}/openni2)
set(drivers ${runtime}/OpenNI2/Drivers)
file(MAKE_DIRECTORY ${drivers})

find_file(OPENNI2_RUNTIME_LIBRARY libOpenNI2.so.0 PATHS ${OPENNI2_LIBRARY_DIRS} ${OPENNI2_LIBDIR}
    PATH_SUFFIXES ${CMAKE_LIBRARY_ARCHITECTURE} HINTS /usr/lib REQUIRED)
get_filename_component(system_folder ${OPENNI2_RUNTIME_LIBRARY} DIRECTORY)
file(CREATE_LINK ${OPENNI2_RUNTIME_LIBRARY} ${runtime}/libOpenNI2.so.0 SYMBOLIC)
file(GLOB stock_drivers ${system_folder}/OpenNI2/Drivers/lib*.so.0)
foreach(driver ${stock_drivers})
    get_filename_component(name ${driver} NAME)
    file(CREATE_LINK ${driver} ${drivers}/${name} SYMBOLIC)
endforeach()

# Drivers are loaded at run time, not linked: building an executable that uses them builds them too.
add_custom_target(touchstone_openni2_runtime)

# touchstone_openni2_driver(NAME SOURCE LIBRARY...): libNAME.so.0 in the runtime folder. SOURCE exports a SourceDriver.
function(touchstone_openni2_driver name source)
    add_library(${name} MODULE ${source})
    touchstone_warnings(${name})
    target_link_libraries(${name} PRIVATE touchstone_source_driver ${ARGN})
    # The driver entry points only: two drivers in one process share no symbols, nor does the program with them.
    set_target_properties(${name} PROPERTIES PREFIX lib SUFFIX .so.0 CXX_VISIBILITY_PRESET hidden
        LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/openni2/OpenNI2/Drivers)
    target_link_options(${name} PRIVATE -Wl,--exclude-libs,ALL)
    add_dependencies(touchstone_openni2_runtime ${name})
endfunction()

# touchstone_use_openni2(TARGET): the executable runs from anywhere with our drivers, and they are built before it.
function(touchstone_use_openni2 target)
    set_property(TARGET ${target} APPEND PROPERTY BUILD_RPATH ${PROJECT_BINARY_DIR}/openni2)
    add_dependencies(${target} touchstone_openni2_runtime)
    if(TOUCHSTONE_SANITIZE)
        target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support/keep_modules_loaded.cpp)
    endif()
endfunction()
