// The second yardstick of the bench: stub for now.
