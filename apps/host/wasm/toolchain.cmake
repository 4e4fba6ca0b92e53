# SPDX-License-Identifier: MIT
# clang for 32-bit WebAssembly with Debian's wasi-libc and libc++.
set(CMAKE_SYSTEM_NAME WASI)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang-22)
set(CMAKE_CXX_COMPILER clang++-22)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)  # the name of Debian's folders
find_program(SUNDER_WASM_AR NAMES llvm-ar-22 llvm-ar REQUIRED)
set(CMAKE_AR ${SUNDER_WASM_AR} CACHE STRING "")
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
# No unwinding: Debian's libc++abi for wasm has none. What is thrown ends the instance, with its
# words (apps/host/wasm/thrown.cpp).
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fexceptions -Wno-deprecated")
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
