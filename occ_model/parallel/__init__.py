"""Jobs for worker processes: the scheduler, the workers and the rules between them. No Qt."""
