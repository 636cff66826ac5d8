# Sourced by ./run and ./test: how many jobs, MPI on small machines and as root, steps with their times.

jobs=$(nproc)

# Open MPI refuses root and more ranks than cores unless it is told; a container is usually both.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_btl_vader_single_copy_mechanism=none

# Objects that ccache keeps serve a checkout in any folder.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1

started=$(date +%s)
step() {
  printf '\n== %s (at %d s)\n' "$1" $(($(date +%s) - started))
}

# Configures and builds a preset; output is kept in a log and shown only where it fails.
build_preset() {
  local preset=$1 launcher=() log
  shift
  command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  log="build/$preset.log"
  mkdir -p build
  if ! { cmake --preset "$preset" -DENFILADE_TOGETHER=ON "${launcher[@]}" "$@" && cmake --build --preset "$preset" -j "$jobs"; } >"$log" 2>&1; then
    tail -n 60 "$log" >&2
    echo "build: preset $preset failed; all of its output is in $log" >&2
    exit 1
  fi
}
