# A study one of whose ranks is killed ends, with an error and soon; started again, it solves only
# what is missing.
set(file sweep_killed.csv)
file(REMOVE ${file})
execute_process(COMMAND ${launch} 2 ${program} ${file} kill TIMEOUT 60
    RESULT_VARIABLE ended OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(ended EQUAL 0 OR ended MATCHES "timeout")
    message(FATAL_ERROR "the study with a killed rank ended with ${ended}: ${said}")
endif()
if(NOT said MATCHES "signal 9|Killed|KILL")
    message(FATAL_ERROR "no rank was killed: ${said}")
endif()
execute_process(COMMAND ${launch} 2 ${program} ${file} resume TIMEOUT 60 RESULT_VARIABLE ended)
if(NOT ended EQUAL 0)
    message(FATAL_ERROR "started again, the study failed: ${ended}")
endif()
