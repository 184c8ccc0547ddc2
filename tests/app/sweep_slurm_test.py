#!/usr/bin/env python3
"""`voxmelt sweep --emit slurm` with a real Slurm of one node, which the test starts and ends: 60 runs, killed on the
way and submitted again, leave the same table. Without slurmctld and slurmd, or not as root, it is skipped.

  sweep_slurm_test.py PROGRAM
"""
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

if not all(map(shutil.which, ("slurmctld", "slurmd", "sbatch"))) or os.geteuid() != 0:
    print("skipped: it wants slurmctld and slurmd (apt-get install slurm-wlm), and root")
    sys.exit(77)

from program import SMALL, voxmelt, write  # noqa: E402
from sweep_test import SIXTY, without_times  # noqa: E402

CONFIG = """ClusterName=voxmelt
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
SlurmdPort={other}
AuthType=auth/none
CredType=cred/none
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/ctld.pid
SlurmdPidFile={folder}/d.pid
SlurmctldLogFile={folder}/ctld.log
SlurmdLogFile={folder}/d.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
SchedulerParameters=sched_interval=1,batch_sched_delay=0
KillWait=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Slurm:
    def __init__(self, folder):
        self.folder = folder
        for name in ("state", "spool"):
            (folder / name).mkdir()
        host = socket.gethostname().split(".")[0]
        (folder / "slurm.conf").write_text(CONFIG.format(host=host, folder=folder, port=free_port(), other=free_port(),
                                                         cpus=len(os.sched_getaffinity(0))))
        self.env = dict(os.environ, SLURM_CONF=str(folder / "slurm.conf"))
        self.daemons = [subprocess.Popen(command, env=self.env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                        for command in (["slurmctld", "-D"], ["slurmd", "-D", "-N", host])]

    def ask(self, *command):
        return subprocess.run(command, env=self.env, capture_output=True, text=True, timeout=60)

    def until(self, what, seconds, condition):
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end:
                logs = "".join(path.read_text()[-3000:] for path in self.folder.glob("*.log"))
                raise AssertionError(f"not within {seconds} s: {what}\n{logs}\n{self.ask('squeue').stdout}")
            time.sleep(0.1)

    def submit(self, script):
        said = self.ask("sbatch", script)
        assert said.returncode == 0, said.stderr
        return said.stdout.split()[-1]

    def is_idle(self):
        asked = self.ask("squeue", "--noheader")
        return asked.returncode == 0 and not asked.stdout.strip()

    def end(self):
        for daemon in self.daemons:
            daemon.terminate()
            daemon.wait(timeout=30)


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        work = folder / "work"
        work.mkdir()
        write(work, SMALL)
        plan = write(work, SIXTY, "plan.toml").name

        def sweep(*arguments):
            done = voxmelt("sweep", plan, *arguments, cwd=work, timeout=600)
            assert done.returncode == 0, done.stderr
            return done.stdout
        sweep("--out", "whole", "--jobs", "2")
        sweep("--out", "array", "--emit", "slurm", "--per-task", "8")
        slurm = Slurm(folder)
        try:
            slurm.until("a node is up", 60, lambda: "idle" in slurm.ask("sinfo", "--noheader").stdout)
            job = slurm.submit(work / "array/sweep.sbatch")
            slurm.until("some runs are complete", 120, lambda: len(list(work.glob("array/runs/*/report.json"))) > 5)
            slurm.ask("scancel", "--signal=KILL", "--full", job)
            slurm.ask("scancel", job)
            slurm.until("the array is gone", 120, slurm.is_idle)
            made = len(list(work.glob("array/runs/*/report.json")))
            assert made < 60, "it was done before it was killed: the test would prove nothing"
            slurm.submit(work / "array/sweep.sbatch")
            slurm.until("the array has ended", 300, slurm.is_idle)
        finally:
            slurm.end()
        said = sweep("--out", "array", "--gather")
        assert "60 of 60 runs are complete" in said, said
        assert without_times(work / "array/table.csv") == without_times(work / "whole/table.csv")
        print(f"killed when {made} runs had ended; then 60 of 60, and the same table")


if __name__ == "__main__":
    main()
