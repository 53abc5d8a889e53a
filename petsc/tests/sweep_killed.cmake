# A study one of whose ranks is killed ends; started again, it solves only what is missing.
set(file sweep_killed.csv)
file(REMOVE ${file})
execute_process(COMMAND ${launch} 2 ${program} ${file} kill RESULT_VARIABLE ended
    OUTPUT_QUIET ERROR_QUIET)
if(ended EQUAL 0)
    message(FATAL_ERROR "the study with a killed rank ended well")
endif()
execute_process(COMMAND ${launch} 2 ${program} ${file} resume RESULT_VARIABLE ended)
if(NOT ended EQUAL 0)
    message(FATAL_ERROR "started again, the study failed: ${ended}")
endif()
