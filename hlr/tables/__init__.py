"""What grows, a row each: line classes, readers, writers. Every stage takes from here what it needs to know of one."""
