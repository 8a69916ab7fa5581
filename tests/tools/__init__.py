"""What tests of more than one folder share: ways to run, to cut, to probe, and programs that must be refused."""
