# SPDX-License-Identifier: Apache-2.0
# Packages of npm, for what is built and tested with Node.js. Nothing of Myotet needs them to run.

find_program(MYOTET_NODE node)
find_program(MYOTET_NPM npm)

# myotet_npm(<folder with package-lock.json> <build folder> <variable>)
# Installs the locked packages below the build folder, once for each lock file. The variable is
# true when they are there; otherwise a warning says why not, and the next configuration tries again.
function(myotet_npm source folder there)
  set(${there} FALSE PARENT_SCOPE)
  if(NOT MYOTET_NODE OR NOT MYOTET_NPM)
    message(WARNING "Node.js and npm are not here; ${source} is left out")
    return()
  endif()
  execute_process(COMMAND ${MYOTET_NODE} --version OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REGEX REPLACE "^v" "" version "${version}")
  if(version VERSION_LESS 18)
    message(WARNING "Node.js is of version ${version}, but 18 is needed; ${source} is left out")
    return()
  endif()
  foreach(file package.json package-lock.json .npmrc)
    configure_file(${source}/${file} ${folder}/${file} COPYONLY)
  endforeach()
  file(SHA256 ${folder}/package-lock.json wanted)
  set(have "")
  if(EXISTS ${folder}/node_modules/.of_lock)
    file(READ ${folder}/node_modules/.of_lock have)
  endif()
  if(NOT have STREQUAL wanted)
    message(STATUS "Installing the packages of ${source}/package-lock.json")
    execute_process(COMMAND ${MYOTET_NPM} ci --fetch-retries=1 --prefer-offline
      WORKING_DIRECTORY ${folder} TIMEOUT 300
      RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
    if(NOT result EQUAL 0)
      message(WARNING "npm could not install the packages of ${source}, which is left out:\n${said}")
      return()
    endif()
    file(WRITE ${folder}/node_modules/.of_lock ${wanted})
  endif()
  set(${there} TRUE PARENT_SCOPE)
endfunction()
