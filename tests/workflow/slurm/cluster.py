"""A Slurm cluster of one node on this machine: controller, node and authentication, gone again at the end."""

from __future__ import annotations

import contextlib
import os
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

CONFIGURATION = """\
ClusterName=oneness
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=5,bf_interval=5
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
MinJobAge=7200
ReturnToService=2
KillWait=2
SlurmctldTimeout=120
SlurmdTimeout=120
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory={memory} State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def free_port() -> int:
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return int(listener.getsockname()[1])


@contextlib.contextmanager
def one_node(folder: Path, cpus: int) -> Iterator[dict[str, str]]:
    """Start the daemons and yield the environment in which sbatch, squeue and scancel reach them."""
    for name in ("munged", "slurmctld", "slurmd", "sbatch"):
        if shutil.which(name) is None and not Path("/usr/sbin", name).exists():
            raise SystemExit(f"{name} is missing: as root, apt-get install slurm-wlm munge")
    folder.mkdir(parents=True, exist_ok=True)
    folder.chmod(0o755)
    for name in ("state", "spool"):
        (folder / name).mkdir(exist_ok=True)
    key = folder / "munge.key"
    key.write_bytes(os.urandom(1024))
    key.chmod(0o400)
    host = socket.gethostname().partition(".")[0]
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 2**20 - 500
    configuration = folder / "slurm.conf"
    configuration.write_text(
        CONFIGURATION.format(
            host=host, folder=folder, cpus=cpus, memory=memory, controller_port=free_port(), node_port=free_port()
        )
    )
    environment = {**os.environ, "SLURM_CONF": str(configuration)}
    environment["PATH"] = environment["PATH"] + os.pathsep + "/usr/sbin"
    files = ("socket", "pid-file", "log-file", "seed-file")
    paths = {"socket": "munge.socket", "pid-file": "munged.pid", "log-file": "munged.log", "seed-file": "munge.seed"}
    munge = ["munged", "--force", "--foreground", f"--key-file={key}", *[f"--{f}={folder / paths[f]}" for f in files]]
    with contextlib.ExitStack() as daemons:
        # jobs are started without the submitter's SLURM_* variables: they look where a cluster has its configuration
        site = Path("/etc/slurm/slurm.conf")
        if site.exists() or site.is_symlink():
            raise SystemExit(f"{site} exists: this machine belongs to a cluster already")
        site.parent.mkdir(parents=True, exist_ok=True)
        site.symlink_to(configuration)
        daemons.callback(site.unlink)
        for call in (munge, ["slurmctld", "-D", "-c", "-i"], ["slurmd", "-D", "-c", "-N", host]):
            log = (folder / f"{call[0]}.out").open("w")
            daemons.callback(log.close)
            daemon = subprocess.Popen(call, env=environment, stdout=log, stderr=subprocess.STDOUT)
            daemons.callback(_end, daemon)
            time.sleep(1.0)
            if daemon.poll() is not None:
                raise SystemExit(f"{call[0]} ended at once: {(folder / f'{call[0]}.out').read_text()[-500:]}")
        _wait_for_node(environment)
        yield environment


def _end(daemon: subprocess.Popen[bytes]) -> None:
    daemon.terminate()
    try:
        daemon.wait(timeout=20)
    except subprocess.TimeoutExpired:
        daemon.kill()
        daemon.wait()


def _wait_for_node(environment: dict[str, str]) -> None:
    for _ in range(60):
        done = subprocess.run(
            ["sinfo", "-h", "-o", "%t"], env=environment, capture_output=True, text=True, timeout=30, check=False
        )
        if done.stdout.strip() in ("idle", "mix", "alloc"):
            return
        time.sleep(1.0)
    raise SystemExit(f"the node does not come up: {done.stdout} {done.stderr}")
