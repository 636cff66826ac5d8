# cmake -D "FILES=a;b" -D FOLDER=... -D NPM=... -P InstallIfcReader.cmake: copies the reader of IFC models, and installs
# web-ifc beside it. Where that cannot be, the build goes on: only an import of IFC asks for it.
file(COPY ${FILES} DESTINATION ${FOLDER})
if(NPM)
  execute_process(COMMAND ${NPM} ci --omit=dev --ignore-scripts --fetch-retries=1 --prefer-offline WORKING_DIRECTORY ${FOLDER} TIMEOUT 180
    RESULT_VARIABLE fault OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(fault)
    message(WARNING "npm could not install web-ifc: IFC models cannot be imported. Build again when it can.\n${said}")
  endif()
else()
  message(WARNING "npm is not installed: IFC models cannot be imported (apt-get install nodejs npm, then configure and build again).")
endif()
if(NOT fault)
  file(TOUCH ${FOLDER}/stamp)
endif()
