# Writes a source file that defines `const char* const lego_loam_sc::<variable>` as the content of
# a text file.
function(embed_text text_file variable output)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${text_file})
  file(READ ${text_file} text)
  set(body "// Generated from ${text_file} by cmake/EmbedText.cmake.\n\nnamespace lego_loam_sc {\n\n")
  string(APPEND body "extern const char* const ${variable};\n")
  string(APPEND body "const char* const ${variable} = R\"embedded(${text})embedded\";\n\n")
  string(APPEND body "}  // namespace lego_loam_sc\n")
  file(CONFIGURE OUTPUT ${output} CONTENT "${body}" @ONLY)
endfunction()
