# What `cmake --install` puts where, and the package that find_package(onesea) finds there.
#   components: client (library, its header and the CMake package), programs
include(CMakePackageConfigHelpers)

set(onesea_exported)
foreach(room base sea ingest proto grpc_stubs wire net model client)
  if(TARGET onesea_${room})
    list(APPEND onesea_exported onesea_${room})
  endif()
endforeach()
install(TARGETS ${onesea_exported} EXPORT onesea_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT client)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/client/embed/onesea DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT client FILES_MATCHING PATTERN "*.h")
# The mathematics alone, onesea::sea, for programs that bring their own recipe.
foreach(room base sea)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/common/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/onesea/common
    COMPONENT client FILES_MATCHING PATTERN "*.h")
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/proto/onesea DESTINATION ${CMAKE_INSTALL_DATADIR}/onesea/proto
  COMPONENT client FILES_MATCHING PATTERN "*.proto")

set(onesea_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/onesea)
install(EXPORT onesea_targets FILE onesea-targets.cmake NAMESPACE onesea:: DESTINATION ${onesea_package_dir} COMPONENT client)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/onesea-config.cmake.in ${PROJECT_BINARY_DIR}/onesea-config.cmake
  INSTALL_DESTINATION ${onesea_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/onesea-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/onesea-config.cmake ${PROJECT_BINARY_DIR}/onesea-config-version.cmake
  DESTINATION ${onesea_package_dir} COMPONENT client)

foreach(program onesea onesea-server onesea-view)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
  endif()
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/deploy/sessions DESTINATION ${CMAKE_INSTALL_DATADIR}/onesea COMPONENT programs)
