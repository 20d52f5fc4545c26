"""Who sat there, on which place of the list, and how many they were."""
