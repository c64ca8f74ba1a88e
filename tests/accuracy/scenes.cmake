add_executable(measure_scenes measure_scenes.cpp scene_visit.cpp)
target_include_directories(measure_scenes PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(measure_scenes PRIVATE touchstone_ui touchstone_image touchstone_system CLI11::CLI11 fmt::fmt)
touchstone_warnings(measure_scenes)
