// Begins when all chapters are registered.
start();
