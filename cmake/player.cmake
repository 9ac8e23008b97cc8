# The page of `brisance view`: viewer/ bundled into share/brisance/player.html beside bin/. Where Node.js and npm are
# missing, or their registry is out of reach, all else is built, and the commands that want the page say so.
find_program(NODE_PROGRAM NAMES node nodejs)
find_program(NPM_PROGRAM npm)
set(PLAYER_PAGE ${CMAKE_BINARY_DIR}/share/brisance/player.html)
set(PLAYER_FOLDER ${CMAKE_BINARY_DIR}/viewer)  # node_modules/ of the bundler and of the tests
if(NODE_PROGRAM AND NPM_PROGRAM)
  file(GLOB player_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/viewer/src/*)
  add_custom_command(OUTPUT ${PLAYER_PAGE}
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${CMAKE_SOURCE_DIR}/viewer -DFOLDER=${PLAYER_FOLDER} -DPAGE=${PLAYER_PAGE}
      -DNODE=${NODE_PROGRAM} -DNPM=${NPM_PROGRAM} -P ${CMAKE_SOURCE_DIR}/cmake/build_player.cmake
    DEPENDS ${player_sources} ${CMAKE_SOURCE_DIR}/viewer/build.mjs ${CMAKE_SOURCE_DIR}/viewer/package.json
      ${CMAKE_SOURCE_DIR}/viewer/package-lock.json ${CMAKE_SOURCE_DIR}/cmake/build_player.cmake
    COMMENT "Bundling the player" VERBATIM)
  add_custom_target(player ALL DEPENDS ${PLAYER_PAGE})
  install(FILES ${PLAYER_PAGE} DESTINATION share/brisance OPTIONAL)
else()
  add_custom_target(player ALL COMMAND ${CMAKE_COMMAND} -E echo "No player: Node.js or npm is missing")
endif()
