touchstone_test(pipeline_particles_test
    SOURCES particle_simulation_test.cpp particle_table_test.cpp
    LIBRARIES touchstone_pipeline)
