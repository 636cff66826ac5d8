// Linked into enfilade-mpi where it is built with sanitizers: libraries that are loaded at run time, such as Open MPI's
// plugins, stay loaded. Otherwise a leak of theirs has no name any more when leaks are told, and cannot be told from ours.
int dlclose(void* library);

int dlclose(void* library) {
  (void)library;
  return 0;
}
