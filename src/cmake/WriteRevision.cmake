# cmake -D SOURCE=... -D HEADER=... -P WriteRevision.cmake: the revision of the source tree as it is built, with a "+" where
# files were changed since; an archive has none. The header is touched only when that is news.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty=+ --abbrev=12 --exclude *
  OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE no_revision)
if(no_revision)
  set(revision unknown)
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define ENFILADE_REVISION \"${revision}\"\n")
