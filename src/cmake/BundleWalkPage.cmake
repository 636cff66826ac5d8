# cmake -D "FILES=a;b" -D WORK=... -D FOLDER=... -D NPM=... -P BundleWalkPage.cmake: installs three.js and esbuild in WORK, and
# makes FOLDER/walk.html, the program of the walk-through page. Where that cannot be, the build goes on without the page.
file(MAKE_DIRECTORY ${FOLDER})
file(COPY ${FILES} DESTINATION ${WORK})
if(NPM)
  execute_process(COMMAND ${NPM} ci --ignore-scripts --fetch-retries=1 --prefer-offline WORKING_DIRECTORY ${WORK} TIMEOUT 180
    RESULT_VARIABLE fault OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT fault)
    execute_process(COMMAND ${NPM} run --silent bundle -- ${FOLDER}/walk.html WORKING_DIRECTORY ${WORK} TIMEOUT 180
      RESULT_VARIABLE fault OUTPUT_VARIABLE said ERROR_VARIABLE said)
  endif()
  if(fault)
    message(WARNING "npm could not bundle three.js: there is no walk-through page. Build again when it can.\n${said}")
  endif()
else()
  message(WARNING "npm is not installed: there is no walk-through page (apt-get install nodejs npm, then configure and build again).")
endif()
if(NOT fault)
  file(TOUCH ${FOLDER}/stamp)
endif()
