# The same bits on any x86-64. glibc chooses variants of sin, exp, ... by the processor that it runs on, and their last bits
# differ; so every program, also one outside of this tree, brings one set of these functions along, musl's, as Debian builds
# it for plain x86-64. They stand before glibc's for the program and for all libraries that it loads. Functions that are
# exact (sqrt, floor, fma, fmod) stay glibc's.
string(REPLACE "gnu" "musl" musl_architecture "${CMAKE_LIBRARY_ARCHITECTURE}")
find_file(MRROC_MUSL libc.a PATHS /usr/lib/${musl_architecture} NO_DEFAULT_PATH)
if(NOT MRROC_MUSL)
  message(FATAL_ERROR "there is no libc.a of musl in /usr/lib/${musl_architecture}: apt-get install musl-dev")
endif()

set(MRROC_MATH_FUNCTIONS)
foreach(function acos acosh asin asinh atan atan2 atanh cbrt cos cosh erf erfc exp exp2 expm1 hypot log log10 log1p log2
                 pow sin sincos sinh tan tanh tgamma)
  list(APPEND MRROC_MATH_FUNCTIONS ${function} ${function}f)
endforeach()

# One object file with these functions and what they need; only their names are seen outside.
set(MRROC_MATH ${CMAKE_BINARY_DIR}/math/math.o)
set(wanted ${MRROC_MATH_FUNCTIONS})
list(TRANSFORM wanted PREPEND --undefined=)
set(kept ${MRROC_MATH_FUNCTIONS})
list(TRANSFORM kept PREPEND --keep-global-symbol=)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/math)
execute_process(COMMAND ${CMAKE_LINKER} -r ${wanted} -o ${MRROC_MATH} ${MRROC_MUSL} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_OBJCOPY} ${kept} ${MRROC_MATH} COMMAND_ERROR_IS_FATAL ANY)
target_link_options(mrroc_options INTERFACE
  $<BUILD_INTERFACE:${MRROC_MATH}> $<INSTALL_INTERFACE:$<INSTALL_PREFIX>/${MRROC_LIBRARIES}/math.o>)

# What is known when a program is compiled, such as sin(0.35), compilers compute by libraries of their own, which differ in
# last bits; and some join a product and a sum to one operation where the processor has it.
set(computed_at_run_time ${MRROC_MATH_FUNCTIONS})
list(TRANSFORM computed_at_run_time PREPEND -fno-builtin-)
target_compile_options(mrroc_options INTERFACE ${computed_at_run_time} -ffp-contract=off)

install(FILES ${MRROC_MATH} DESTINATION ${MRROC_LIBRARIES})
install(FILES /usr/share/doc/musl-dev/copyright DESTINATION share/doc/mrroc/licenses RENAME musl.txt)
