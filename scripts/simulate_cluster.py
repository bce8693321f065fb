#!/usr/bin/python3
"""How a search grows with workers: a simulation of batches, one coordinator and many workers.

    scripts/simulate_cluster.py [--send-ms 1] [--receive-ms 1] [--start-ms 50] [--batch-ms 50] [--design-ms 10]
                                [--spread 0.5]

A batch is a list of tasks of 150 designs each. The coordinator sends tasks and takes in results one at a time; a task
runs on the worker that has it, where its process has to start first; the next batch begins when all of the last one is
in (that barrier makes results independent of who was faster). Task times are log-normal around their mean. Prints, for
every number of workers and of tasks in a batch, the speed-up over one worker without any overhead, and how busy the
coordinator is.
"""
import argparse
import heapq
import math
import random

DESIGNS_A_TASK = 150


def simulate(workers, tasks_a_batch, options, batches=5, seed=1):
    """(time, time of all tasks on one worker, time that the coordinator was busy), in seconds."""
    rng = random.Random(seed)
    mean = DESIGNS_A_TASK * options.design_ms / 1000
    sigma = options.spread
    mu = math.log(mean) - sigma * sigma / 2
    send, receive, start = options.send_ms / 1000, options.receive_ms / 1000, options.start_ms / 1000
    now = busy = work = 0.0
    for _ in range(batches):
        now += options.batch_ms / 1000
        busy += options.batch_ms / 1000
        waiting = [rng.lognormvariate(mu, sigma) for _ in range(tasks_a_batch)]
        work += sum(waiting)
        waiting.reverse()
        free = workers
        running = []  # ends of the tasks that are out
        while waiting or running:
            if running and (running[0] <= now or not (waiting and free)):
                now = max(now, heapq.heappop(running)) + receive
                busy += receive
                free += 1
            else:
                now += send
                busy += send
                free -= 1
                heapq.heappush(running, now + start + waiting.pop())
    return now, work, busy


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--send-ms", type=float, default=1, help="the coordinator's time to send one task")
    parser.add_argument("--receive-ms", type=float, default=1, help="its time to take one result in")
    parser.add_argument("--start-ms", type=float, default=50, help="a worker's time to start the program for a task")
    parser.add_argument("--batch-ms", type=float, default=50, help="its time between batches: fold, commit, propose")
    parser.add_argument("--design-ms", type=float, default=10, help="mean time to score one design")
    parser.add_argument("--spread", type=float, default=0.5, help="sigma of the logarithm of task times")
    options = parser.parse_args()
    sizes = [16, 160, 1600, 16000]
    print(f"a design {options.design_ms:g} ms, a task {DESIGNS_A_TASK * options.design_ms / 1000:g} s, "
          f"send {options.send_ms:g} ms, receive {options.receive_ms:g} ms, start {options.start_ms:g} ms, "
          f"batch {options.batch_ms:g} ms")
    print("| workers | " + " | ".join(f"{size} tasks a batch" for size in sizes) + " |")
    print("|---" * (len(sizes) + 1) + "|")
    for workers in [1, 3, 10, 30, 100, 300, 1000]:
        row = []
        for size in sizes:
            time, work, busy = simulate(workers, size, options)
            row.append(f"{work / time:.1f} ({100 * busy / time:.0f} %)")
        print(f"| {workers} | " + " | ".join(row) + " |")


if __name__ == "__main__":
    main()
