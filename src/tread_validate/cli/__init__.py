"""The command line: the only place that reads arguments, prints and picks exit codes."""

import os

# Every matrix here is small: threads of the linear algebra library would only wait for each other. It reads this when
# it is loaded, so it is said before any module of a verb is.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
