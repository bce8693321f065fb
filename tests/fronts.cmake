# Every design on the front of every shipped problem, scored again by the slow witness.
function(formotion_front_test problem evaluations)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/front_${problem})
  set(file ${CMAKE_SOURCE_DIR}/problems/feeder/${problem}.json)
  add_test(NAME front.${problem}.search
           COMMAND formotion optimize ${file} --evaluations ${evaluations} --out ${folder} --overwrite)
  # The exit code says whether a design is feasible (today's track is not); that the run ended is looked for instead.
  set_tests_properties(front.${problem}.search PROPERTIES FIXTURES_SETUP front_${problem} LABELS fronts
                       PASS_REGULAR_EXPRESSION "report: ")
  add_test(NAME front.${problem} COMMAND witness_front ${file} ${folder}/pareto.json)
  set_tests_properties(front.${problem} PROPERTIES FIXTURES_REQUIRED front_${problem} LABELS fronts)
endfunction()

formotion_front_test(el_bracket 20000)
formotion_front_test(bibazu_l_part 2000)
formotion_front_test(ratchet_with_hub 6000)
formotion_front_test(plate_with_hole 8000)
formotion_front_test(box_on_three_faces 4000)
formotion_front_test(stamped_bracket 700)
formotion_front_test(todays_track 10)
