. /tmp/v/bin/activate; export PYTHONPATH=/work/main; cd /tmp/newcomer; M=/work/shared/models
export HLR_CACHE=/tmp/newcomer/cache
H="python -m hlr"
t(){ echo "--- $*"; timeout 120 "$@" 2>&1; echo "rc=$?"; }
