# SPDX-License-Identifier: MIT
# Manual pages and completions where Debian's shells and man look. Needs: `sunder` (the program) and `data` (share/).
function(write_from words file)
  execute_process(COMMAND ${sunder} ${words} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  file(WRITE "$ENV{DESTDIR}${data}/${file}" "${text}")
endfunction()
write_from("completion;bash" bash-completion/completions/sunder)
write_from("completion;zsh" zsh/vendor-completions/_sunder)
write_from("completion;fish" fish/vendor_completions.d/sunder.fish)
write_from("man" man/man1/sunder.1)
foreach(command run static modes fragments check convert split cut refine export demo)
  write_from("man;${command}" man/man1/sunder-${command}.1)
endforeach()
